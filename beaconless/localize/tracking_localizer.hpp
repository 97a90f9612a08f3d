// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/place_watch.hpp"
#include "beaconless/localize/relocalizer.hpp"
#include "beaconless/localize/rivals.hpp"
#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/localize/trust.hpp"
#include "beaconless/map/nearness_pyramid.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/map_fit.hpp"
#include "beaconless/track/odometry_track.hpp"
#include "beaconless/track/way_check.hpp"

namespace beaconless {

/// Follows a robot from scan to scan: predicts, lets a ScanMatcher fit the scan, and judges what came of it.
///
/// Every method by name is this class with a matcher of its own. Source: dissertation 3.2 and 3.3; prediction
/// from the last poses. Differs: points are fitted as they would be seen from where the laser was at the
/// stamp, by the twist so far, and once more where the fit tells another twist; features are taken from the
/// sweep as if it were seen at once, and what the motion adds is put into the covariance. A fit that explains
/// unusually little of the scan is tried again from the best poses around the prediction (search_around),
/// because a robot that turns by 20° between two scans is outside the basin of any of the matchers; where a
/// matcher of features gets nowhere from those either, the whole scan stands in for it and the status is
/// degraded. How much a fit explains is told by the whole scan, whatever part of it the matcher used.
class TrackingLocalizer final : public Localizer {
 public:
  TrackingLocalizer(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
                    std::unique_ptr<ScanMatcher> matcher);
  TrackingLocalizer(const TrackingLocalizer&) = delete;  // its parts share a finder
  TrackingLocalizer& operator=(const TrackingLocalizer&) = delete;

  void start_at(const Pose2& map_from_base) override;
  void start_anywhere(const std::optional<SearchRegion>& within) override;
  std::span<const PoseCandidate> candidates() const override { return relocalizer_.candidates(); }
  PoseEstimate update(const Event& event) override;

 private:
  /// How far a fit may be from the prediction: the larger of a distance and some of its standard deviations.
  struct Tolerance {
    double sigmas = 0.0;
    double position_m = 0.0;
    double heading_rad = 0.0;
  };

  PoseEstimate track(const Scan& scan);
  std::optional<PoseEstimate> find(const Scan& scan);
  void hear_search(const Scan& scan, const Stamp& before);
  bool is_bent_by(const ToldTwist& motion, const Scan& scan) const;
  void search_anywhere(const FloorPlan::Bounds& box, int agreeing_scans, PlaceFinder::Wanted wanted = {});
  void hold_against_others(const Scan& scan);
  bool is_long_through_walls(Stamp stamp);
  void observe(const Scan& scan, const Pose2& map_from_laser, const Eigen::Matrix3d& covariance,
               const Prediction& prediction);
  MatchResult fit_by_new_motion(const MatchResult& first, Prediction& prediction, const Scan& scan);
  std::string_view caveat_of(const MatchResult& match, bool is_other) const;
  bool is_swept(const Scan& scan) const;
  ToldTwist motion_during(const Scan& scan, MotionFilter motion) const;
  std::optional<ToldTwist> told_by_sweep(const Scan& scan, const MatchResult& match,
                                         const ToldTwist& assumed);
  Eigen::Matrix3d sweep_covariance(const PoseEstimate& estimate, const Prediction& prediction,
                                   const Scan& scan) const;
  MatchResult fit_from(const Pose2& guess);
  MapFit fit_at(const Prediction& prediction) const;
  bool is_further(const MatchResult& match, const Prediction& prediction, const Tolerance& than) const;
  bool is_jump(const MatchResult& match, const Prediction& prediction) const;
  bool is_worth_searching(const MatchResult& match, const Prediction& prediction);
  std::string_view reason_to_coast(const MatchResult& match, const Prediction& prediction) const;
  std::string_view reason_against_features(const MatchResult& match, const Prediction& prediction) const;
  std::string_view reason_against(const MatchResult& match, const Prediction& prediction) const;
  std::span<const StartPose> starts_around(const Prediction& prediction);
  template <class Fit>
  MatchResult best_of(std::span<const StartPose> starts, const MatchResult& first,
                      const Prediction& prediction, const Fit& fit);
  std::optional<MatchResult> fit_whole_scan(std::span<const StartPose> starts, const Prediction& prediction);
  PoseEstimate accept(const MatchResult& match, const Prediction& prediction, const Scan& scan,
                      std::string_view reservation);
  PoseEstimate stand_in(const MatchResult& whole_scan, const Prediction& prediction, const Scan& scan);
  PoseEstimate coast(const Prediction& prediction, Stamp stamp, std::string_view reason);

  LocalizerConfig config_;
  std::shared_ptr<const SurfaceMap> map_;
  std::unique_ptr<ScanMatcher> matcher_;
  NearnessPyramid nearness_;
  Pose2 laser_from_base_;
  MotionFilter motion_;
  OdometryTrack odometry_;
  WayCheck way_;
  Rivals rivals_;
  PlaceFinder finder_;
  Relocalizer relocalizer_;
  PlaceWatch watch_;
  Trust trust_;
  std::optional<ToldTwist> bent_;  // what the sweep at hand told of the motion during it
  std::optional<Stamp> last_scan_;
  Health health_;
  IcpScratch scratch_;
  LocalSearchScratch search_scratch_;
  std::vector<StartPose> starts_;
  std::vector<Eigen::Vector2d> points_;  // laser frame at the stamp
  std::vector<double> times_s_;          // of the points, after the stamp
  PoseEstimate last_;
  double explained_ = 0.0;   // share of the last scan
  int surprised_scans_ = 0;  // that are still to agree after a jump
  bool started_ = false;
  bool is_anywhere_ = false;        // nothing is believed of the pose
  bool was_seen_standing_ = false;  // while looked for, as long as its motion is unknown
  std::optional<ToldTwist>
      found_motion_;           // how the robot moved between the last scans, while it is looked for
  bool is_new_place_ = false;  // it was found elsewhere than where it was thought to be
  bool was_placed_ = false;    // something was, before that
  bool first_scan_ = true;
  bool is_covered_ = false;
  bool is_through_walls_ = false;  // beams pass through walls where the robot is thought to be
  int lost_scans_ = 0;
  int coasted_scans_ = 0;   // in a row
  int weak_scans_ = 0;      // fits in a row that explain little
  bool is_shaken_ = false;  // the robot may have been carried off since the last fit
  std::optional<Stamp> through_since_;
};

}  // namespace beaconless
