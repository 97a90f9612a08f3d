// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "beaconless/features/keypoint_radius.hpp"
#include "beaconless/features/unrolled_scan.hpp"

namespace beaconless {

/// For every hit of a scan the beams around it that its radius reaches.
///
/// Those of the hit at a place are among the places first[p] … last[p]: these two lie within the radius (or
/// are the hit itself), places between them need not (ask has()). The neighbourhood stays within the run of
/// hits around p. Values at places without a hit, and in the padding, mean nothing.
class BeamNeighbourhoods {
 public:
  /// Cost: beams x window, without a branch that depends on the data; allocates only when the scan has more
  /// beams than any before. Source: Kallasi et al. 2016, section III-A.
  void assign(const Scan& scan, const KeypointRadius& radius);

  bool has(std::size_t centre, std::size_t place) const {
    const float dx = points.x_m[place] - points.x_m[centre];
    const float dy = points.y_m[place] - points.y_m[centre];
    return dx * dx + dy * dy <= radius_m[centre] * radius_m[centre];
  }

  UnrolledScan points;
  std::vector<float> radius_m;
  std::vector<std::int32_t> window;  ///< no place further off can be within the radius
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> last;

 private:
  void assign_block(std::size_t begin, std::size_t count);
  void cut_at_gaps(std::size_t begin, std::size_t count);
};

}  // namespace beaconless
