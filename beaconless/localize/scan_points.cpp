// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/scan_points.hpp"

namespace beaconless {

std::span<const Eigen::Vector2d> ScanPoints::of(const Scan& scan) {
  points_.clear();
  if (from_ == PointsFrom::whole_scan) {
    for (std::size_t beam = 0; beam < scan.size(); ++beam)
      if (scan.is_hit(beam)) points_.push_back(scan.point(beam));
    return points_;
  }
  detect(scan, detector_, detecting_, scratch_, keypoints_);
  if (from_ == PointsFrom::keypoints) {
    for (const Keypoint& keypoint : keypoints_) points_.push_back(keypoint.point);
    return points_;
  }
  find_interest_regions(scan, keypoints_, regions_, around_);
  for (const std::size_t beam : around_.beams) points_.push_back(scan.point(beam));
  return points_;
}

}  // namespace beaconless
