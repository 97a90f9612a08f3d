// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "beaconless/geometry/trajectory.hpp"

namespace beaconless::eval {

/// An estimate and where the reference was at the same moment.
struct PosePair {
  Stamp stamp;
  Pose2 estimate;
  Pose2 reference;

  friend bool operator==(const PosePair&, const PosePair&) = default;
};

/// The pairs of two trajectories, in order of time.
struct Association {
  std::vector<PosePair> pairs;
  std::size_t unmatched_count = 0;  ///< estimates without a reference

  friend bool operator==(const Association&, const Association&) = default;
};

/// Pairs every estimate with the reference at its stamp, interpolated along a constant twist.
///
/// An estimate before the first or after the last reference, between two that are more than `max_gap_s`
/// apart, or of a pose that is not finite, stays unmatched. Where a stamp repeats (logs with coarse clocks),
/// the first estimate of it goes with the first reference of it, the second with the second, and so on;
/// further ones with the last. Cost: O(n log m).
Association associate(const Trajectory& estimate, const Trajectory& reference, double max_gap_s = 1.0);

}  // namespace beaconless::eval
