// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/map_fit.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// The scan at hand: its points as seen from where the laser was at the stamp, and how they fit the map.
///
/// Points are in the laser frame, poses to fit from are map_from_laser. How much a fit explains is told by
/// the whole scan, whatever part of it the matcher used. Allocates nothing once buffers have grown.
class SeenScan {
 public:
  SeenScan(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
           std::unique_ptr<ScanMatcher> matcher);

  /// Takes in a scan, which stays until the next call. In: the motion of the base during it; where the laser
  /// should be at the stamp, and how sure that is.
  void see(const Scan& scan, const ToldTwist& motion, const Pose2& expected,
           const Eigen::Matrix3d& covariance);

  /// Whether each beam is seen from where the laser was at its time: features are taken from the sweep as if
  /// it were seen at once.
  bool is_unbent(const Scan& scan) const;

  std::span<const Eigen::Vector2d> points() const { return points_; }

  /// Whether hardly a beam comes from far away.
  bool is_covered() const { return is_covered_; }

  /// The matcher's fit.
  MatchResult fit_from(const Pose2& guess);

  /// The fit of the whole scan, whatever the matcher.
  MatchResult fit_whole_from(const Pose2& guess);

  /// How well it lies on the map where the base should be.
  MapFit fit_at(const Prediction& prediction) const;

  ScanMatcher& matcher() { return *matcher_; }
  const ScanMatcher& matcher() const { return *matcher_; }

 private:
  std::shared_ptr<const SurfaceMap> map_;
  std::unique_ptr<ScanMatcher> matcher_;
  IcpConfig icp_;
  Pose2 base_from_laser_;
  Pose2 laser_from_base_;
  bool deskew_;
  std::vector<Eigen::Vector2d> points_;
  bool is_covered_ = false;
  IcpScratch scratch_;
};

}  // namespace beaconless
