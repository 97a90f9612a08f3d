// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace beaconless {

/// A point of a scan that looks the same from elsewhere, as FALKO, OC and FLIRT find them.
struct Keypoint {
  std::size_t beam = 0;                             ///< the beam it was found at
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< sensor frame; may lie between beams
  double orientation_rad = 0.0;                     ///< in [-pi, pi); what it means, the detector says
  double scale_m = 0.0;                             ///< radius of the neighbourhood that it was found in
  double score = 0.0;                               ///< more is better; comparable within one detector

  friend bool operator==(const Keypoint&, const Keypoint&) = default;
};

}  // namespace beaconless
