// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "beaconless/localize/amcl_cloud.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// Adaptive Monte-Carlo localization as a localizer: what people know from ROS's amcl.
///
/// The estimate is the mean of the heaviest cluster; its covariance is that of all particles around it.
/// Between updates wheels carry it on. Source: ParticleFilter's; ROS's amcl. Differs: without odometry the
/// cloud moves on as matches of the last scans did, by a MotionFilter, and every scan is an update; a scan
/// that explains less than usual is one too; a lost robot's cloud is fed with what a search around it finds.
/// With a matcher of walls each estimate is polished by the whole scan, as long as that agrees with the
/// cloud, which never hears of it.
class AmclLocalizer final : public Localizer {
 public:
  /// In: `polish` may be null.
  AmclLocalizer(const LocalizerConfig& config, const Map& map, std::shared_ptr<const SurfaceMap> surfaces,
                std::unique_ptr<ScanMatcher> polish);

  void start_at(const Pose2& map_from_base) override;
  void start_anywhere(const std::optional<SearchRegion>& within) override;
  std::span<const PoseCandidate> candidates() const override { return candidates_; }
  PoseEstimate update(const Event& event) override;

 private:
  using Belief = AmclCloud::Belief;

  void begin();
  AmclCloud::Step step_to(const Scan& scan);
  void observe(const Scan& scan, const AmclCloud::Step& step);
  Belief polished(const Scan& scan);
  Belief followed(const Belief& belief);
  void choose_points();
  std::optional<Belief> if_agreed(const MatchResult& match) const;
  void learn_motion(const Belief& belief, Stamp stamp, PoseEstimate& estimate);
  PoseEstimate judge(const Belief& belief, const Scan& scan);
  std::string_view doubt() const;
  void list_candidates();
  double explained_share(const Pose2& map_from_base) const;

  LocalizerConfig config_;
  std::shared_ptr<const SurfaceMap> map_;
  std::unique_ptr<ScanMatcher> polish_;
  AmclCloud cloud_;
  MotionFilter motion_;
  OdometryTrack odometry_;
  Health health_;
  std::vector<Eigen::Vector2d> points_;  // laser frame at the stamp
  std::vector<Eigen::Vector2d> few_points_;
  IcpScratch icp_scratch_;
  std::vector<PoseCandidate> candidates_;
  std::optional<Stamp> last_scan_;
  double last_step_s_ = 0.0;
  PoseEstimate last_;
  bool is_started_ = false;
  bool is_placed_ = true;      // by a start pose
  bool is_searching_ = false;  // started anywhere, and not found yet
  bool is_doubtful_ = false;   // the last scan explained less than usual
  bool is_by_wheels_ = false;  // the way to the last scan was told by wheels
  int agreed_ = 0;             // scans in a row with the cloud in one place
};

}  // namespace beaconless
