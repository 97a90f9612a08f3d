// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/point_feature.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// How long features are remembered that are no longer seen.
struct FeatureTrackerConfig {
  int keep_scans = 8;             ///< a feature that was not seen for more scans is forgotten
  double same_sigma = 4.0;        ///< one seen this near, in standard deviations of both, is the same one …
  double same_least_m = 0.05;     ///< … and so is one nearer than this
  double growth_per_scan = 0.25;  ///< by which a remembered feature's variance grows each scan
};

void describe(Fields& fields, FeatureTrackerConfig& config);

/// Remembers features for a few scans after they vanish, so that a corner that is found in every other scan
/// only does not make the pose jump.
///
/// They are kept where they were in the map; as seen from where the robot should be now they get the
/// uncertainty of that expectation besides their own, so that what is seen outweighs what is remembered, and
/// all of them together tell no more than the expectation did.
/// Source: dissertation 4.4, feature tracking. Differs: the dissertation does not say in which frame features
/// were kept; old coordinates in the sensor's frame would drag a moving robot back to where it was.
class FeatureTracker {
 public:
  explicit FeatureTracker(const FeatureTrackerConfig& config = {}) : config_(config) {}

  /// Appends what is remembered and not among `seen`. In: laser frame; where the laser should be now, and the
  /// covariance of that (x, y along the map axes). Cost: remembered x seen.
  void recall(const Pose2& map_from_laser, const Eigen::Matrix3d& covariance,
              std::vector<PointFeature>& seen);

  /// Takes the features of this scan (laser frame) to remember, with the pose that was found for it.
  void remember(std::span<const PointFeature> seen, const Pose2& map_from_laser);

  void forget() { kept_.clear(); }

  std::size_t size() const { return kept_.size(); }

 private:
  struct Kept {
    PointFeature feature;  // map frame
    int unseen_scans = 0;
  };

  FeatureTrackerConfig config_;
  std::vector<Kept> kept_;
};

}  // namespace beaconless
