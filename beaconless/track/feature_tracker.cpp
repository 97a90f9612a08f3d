// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/feature_tracker.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

PointFeature moved(const PointFeature& feature, const Pose2& pose) {
  const Eigen::Matrix2d rotation = pose.rotation();
  return {pose * feature.point, rotation * feature.covariance * rotation.transpose(),
          wrap_angle(feature.orientation_rad + pose.theta_rad), feature.opening_rad};
}

/// How uncertain a point is that hangs on an uncertain pose; map axes.
Eigen::Matrix2d carried(const Eigen::Matrix3d& pose_covariance, const Eigen::Vector2d& arm) {
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return jacobian * pose_covariance * jacobian.transpose();
}

}  // namespace

void describe(Fields& fields, FeatureTrackerConfig& config) {
  fields("keep_scans", config.keep_scans, {0, 1000}, "scans for which an unseen feature is remembered");
  fields("same_sigma", config.same_sigma, {0.0, 100.0},
         "a feature seen this near to a remembered one is the same");
  fields("same_least_m", config.same_least_m, {0.0, 10.0}, "and so is one nearer than this");
  fields("growth_per_scan", config.growth_per_scan, {0.0, 1e3},
         "share by which a remembered feature's variance grows each scan");
}

void FeatureTracker::recall(const Pose2& map_from_laser, const Eigen::Matrix3d& covariance,
                            std::vector<PointFeature>& seen) {
  const Pose2 laser_from_map = map_from_laser.inverse();
  const Eigen::Matrix2d to_laser = laser_from_map.rotation();
  const std::size_t seen_count = seen.size();
  const auto matches = [&](const PointFeature& remembered) {
    return std::any_of(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(seen_count),
                       [&](const PointFeature& now) {
                         const Eigen::Vector2d apart = now.point - remembered.point;
                         const Eigen::Matrix2d spread = now.covariance + remembered.covariance;
                         return apart.norm() < config_.same_least_m ||
                                apart.dot(spread.inverse() * apart) < config_.same_sigma * config_.same_sigma;
                       });
  };
  // All hang on the same expectation: told apart, each may count for its share of it only.
  const auto shared = static_cast<double>(kept_.size());
  for (Kept& kept : kept_) {
    // 1. Where it should be now, and how sure that is.
    PointFeature here = moved(kept.feature, laser_from_map);
    const Eigen::Vector2d arm = kept.feature.point - map_from_laser.translation();
    here.covariance *= 1.0 + config_.growth_per_scan * (kept.unseen_scans + 1);
    here.covariance += shared * to_laser * carried(covariance, arm) * to_laser.transpose();
    // 2. One that is seen needs no memory; one unseen for too long is gone.
    kept.unseen_scans = matches(here) ? config_.keep_scans + 1 : kept.unseen_scans + 1;
    if (kept.unseen_scans <= config_.keep_scans) seen.push_back(here);
  }
  std::erase_if(kept_, [&](const Kept& kept) { return kept.unseen_scans > config_.keep_scans; });
}

void FeatureTracker::remember(std::span<const PointFeature> seen, const Pose2& map_from_laser) {
  for (const PointFeature& feature : seen) kept_.push_back({moved(feature, map_from_laser), 0});
}

}  // namespace beaconless
