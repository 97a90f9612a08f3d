// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/features/detector.hpp"
#include "beaconless/features/interest_regions.hpp"

namespace beaconless {

/// Which points of a scan are fitted to the map.
enum class PointsFrom : int {
  whole_scan,  ///< every beam that hit something
  keypoints,   ///< what a detector found
  regions,     ///< the beams around what a detector found
};

/// Takes points from scans, one kind of them. Source: dissertation 3.3.1 and the three approaches of 4.5.
class ScanPoints {
 public:
  ScanPoints(PointsFrom from, Detector detector, const DetectorsConfig& detecting,
             const InterestRegionsConfig& regions)
      : from_(from), detector_(detector), detecting_(detecting), regions_(regions) {}

  PointsFrom from() const { return from_; }

  /// The points of a scan, laser frame; they stay until the next call. Cost: none, detect(), and
  /// find_interest_regions() besides; nothing is allocated once buffers have grown.
  std::span<const Eigen::Vector2d> of(const Scan& scan);

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
