// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/scan_points.hpp"

#include <cmath>

namespace beaconless {
namespace {

constexpr double kSeenArm_m = 0.2;

}  // namespace

std::array<Eigen::Vector2d, 2> cross_arms(double orientation_rad, double length_m) {
  const Eigen::Vector2d along(length_m * std::cos(orientation_rad), length_m * std::sin(orientation_rad));
  return {along, {-along.y(), along.x()}};
}

std::span<const Eigen::Vector2d> ScanPoints::of(const Scan& scan, std::span<const Eigen::Vector2d> all) {
  if (from_ == PointsFrom::whole_scan) return all;
  points_.clear();
  detect(scan, detector_, detecting_, scratch_, keypoints_);
  if (from_ == PointsFrom::keypoints) {
    for (const Keypoint& keypoint : keypoints_)
      for (const Eigen::Vector2d& arm : cross_arms(keypoint.orientation_rad, kSeenArm_m))
        for (const double side : {-1.0, 1.0}) points_.emplace_back(keypoint.point + side * arm);
    return points_;
  }
  find_interest_regions(scan, keypoints_, regions_, around_);
  for (const std::size_t beam : around_.beams) points_.push_back(scan.point(beam));
  return points_;
}

}  // namespace beaconless
