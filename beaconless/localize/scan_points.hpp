// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/features/detector.hpp"
#include "beaconless/features/interest_regions.hpp"

namespace beaconless {

/// Which points of a scan are fitted to the map.
enum class PointsFrom : int {
  whole_scan,  ///< every beam that hit something
  keypoints,   ///< what a detector found, each as the four ends of a cross
  regions,     ///< the beams around what a detector found
};

/// The arms of the cross that stands for a keypoint, in a scan and in a map of keypoints alike.
///
/// A grid matcher sees how far a point is from a wall, one number a point, and so little of where along the
/// wall it is; the ends of a cross tell both.
std::array<Eigen::Vector2d, 2> cross_arms(double orientation_rad, double length_m);

/// Takes points from scans, one kind of them. Source: dissertation 3.3.1 and the three approaches of 4.5.
class ScanPoints {
 public:
  ScanPoints(PointsFrom from, Detector detector, const DetectorsConfig& detecting,
             const InterestRegionsConfig& regions)
      : from_(from), detector_(detector), detecting_(detecting), regions_(regions) {}

  PointsFrom from() const { return from_; }

  /// The points of a scan, of which `all` are given; laser frame, they stay until the next call. Cost: none,
  /// detect(), and find_interest_regions() besides; nothing is allocated once buffers have grown.
  std::span<const Eigen::Vector2d> of(const Scan& scan, std::span<const Eigen::Vector2d> all);

 private:
  PointsFrom from_;
  Detector detector_;
  DetectorsConfig detecting_;
  InterestRegionsConfig regions_;
  DetectorScratch scratch_;
  std::vector<Keypoint> keypoints_;
  InterestRegions around_;
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace beaconless
