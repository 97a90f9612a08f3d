// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "beaconless/features/descriptor_distance.hpp"
#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"

namespace beaconless {

/// Cumulative Gaussian Histogram: in which directions from a keypoint the beams around it end; 16 bins that
/// sum to 1. Bin 0 is centred on the keypoint's orientation, the others follow counter-clockwise.
struct CghDescriptor {
  static constexpr int kBins = 16;

  std::array<float, kBins> bins{};

  friend bool operator==(const CghDescriptor&, const CghDescriptor&) = default;
};

struct CghConfig {
  NeighbourhoodConfig neighbourhood;
  double inner_m = 0.02;  ///< nearer points have no direction to speak of
};

void describe(Fields& fields, CghConfig& config);

/// The largest distance() at which two descriptors count as of the same place, as in falkolib.
inline constexpr double kCghSame = 0.2;

/// Symmetric chi-square, in [0, 1].
inline double distance(const CghDescriptor& a, const CghDescriptor& b) {
  return symmetric_chi_square(a.bins, b.bins);
}

/// The descriptor turned counter-clockwise by whole bins of 22.5°, either way.
CghDescriptor rotated(const CghDescriptor& descriptor, int bins);

/// Describes each keypoint by the directions of the beams around it, one descriptor a keypoint, uniform where
/// no beam ends nearby.
///
/// Each beam adds 5 to its bin and 1 to both neighbours. In: keypoints in the sensor frame; the histogram
/// turns with their orientation. A beam that is no hit adds nothing. Cost: as describe_bsc. Source: Kallasi,
/// Lodi Rizzini and Caselli 2016. Differs: falkolib divides 0 by 0 where no beam is near, leaves turning to
/// the caller, and its radius grows with range (here an option). Bins are centred on the orientation: a right
/// angle's arms would lie on their borders.
std::vector<CghDescriptor> describe_cgh(const Scan& scan, std::span<const Keypoint> keypoints,
                                        const CghConfig& config = {});
void describe_cgh(const Scan& scan, std::span<const Keypoint> keypoints, const CghConfig& config,
                  std::vector<CghDescriptor>& out);

}  // namespace beaconless
