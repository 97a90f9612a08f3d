// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/scan_segment.hpp"

namespace beaconless {

struct InterestRegionsConfig {
  NeighbourhoodConfig neighbourhood;
};

void describe(Fields& fields, InterestRegionsConfig& config);

/// The beams of a scan that lie near keypoints, each once, in three forms that say the same.
struct InterestRegions {
  std::vector<ScanSegment> segments;  ///< runs of such beams, ascending; on a full circle the last may run
                                      ///< over the end of the arrays
  std::vector<std::size_t> beams;     ///< ascending
  std::vector<std::uint8_t> mask;     ///< one a beam of the scan: 1 where it belongs

  friend bool operator==(const InterestRegions&, const InterestRegions&) = default;
};

/// Finds the beams that end near a keypoint: more to hold on to than corners alone, less to carry than the
/// whole scan.
///
/// In: keypoints in the sensor frame. Regions that overlap or touch become one; a beam that is no hit ends a
/// run, and the region goes on behind it. Cost: the sum of the neighbourhoods' beams, and one pass over the
/// scan; the second form allocates nothing once `out` has grown. Source: dissertation 3.3.1, second approach,
/// and 4.5, third approach, which match HectorSLAM on such regions; neither tells a radius. Differs: no beam
/// comes twice, or where keypoints stand close their walls would weigh more than others.
InterestRegions find_interest_regions(const Scan& scan, std::span<const Keypoint> keypoints,
                                      const InterestRegionsConfig& config = {});
void find_interest_regions(const Scan& scan, std::span<const Keypoint> keypoints,
                           const InterestRegionsConfig& config, InterestRegions& out);

}  // namespace beaconless
