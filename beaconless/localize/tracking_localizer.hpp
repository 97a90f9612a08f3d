// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "beaconless/localize/follower.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/place_watch.hpp"
#include "beaconless/localize/relocalizer.hpp"
#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/localize/search_motion.hpp"
#include "beaconless/localize/seen_scan.hpp"
#include "beaconless/localize/sweep_motion.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/track/odometry_track.hpp"
#include "beaconless/track/way_check.hpp"

namespace beaconless {

/// Knows where a robot is from scan to scan: looks for it where it may be anywhere, follows it from where it
/// is, holds that place against others where it is in doubt, and looks for it again when it is gone.
///
/// Every method by name is this class with a matcher of its own. Cost: that of Follower a scan; while it is
/// looked for, and where its place is in doubt, that of PlaceFinder.
class TrackingLocalizer final : public Localizer {
 public:
  TrackingLocalizer(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
                    std::unique_ptr<ScanMatcher> matcher);

  void start_at(const Pose2& map_from_base) override;
  void start_anywhere(const std::optional<SearchRegion>& within) override;
  std::span<const PoseCandidate> candidates() const override { return relocalizer_.candidates(); }
  PoseEstimate update(const Event& event) override;

 private:
  PoseEstimate without_scan(const Event& event) const;
  std::optional<PoseEstimate> find(const Scan& scan);
  void hold_against_others(const Scan& scan);
  bool is_gone(const Scan& scan);
  void search_anywhere(const FloorPlan::Bounds& box, int agreeing_scans, PlaceFinder::Wanted wanted = {});

  LocalizerConfig config_;
  std::shared_ptr<const SurfaceMap> map_;
  Pose2 laser_from_base_;
  OdometryTrack odometry_;
  SeenScan seen_;
  SweepMotion sweep_;
  Follower follower_;
  PlaceFinder finder_;
  Relocalizer relocalizer_;
  SearchMotion search_motion_;
  PlaceWatch watch_;
  WayCheck way_;
  PoseEstimate last_;
  std::optional<Stamp> last_scan_;
  bool started_ = false;
  bool is_anywhere_ = false;  // nothing is believed of the pose
  bool was_placed_ = false;   // something was, before that
};

}  // namespace beaconless
