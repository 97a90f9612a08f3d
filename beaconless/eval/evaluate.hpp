// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "beaconless/eval/errors.hpp"
#include "beaconless/geometry/trajectory.hpp"

namespace beaconless::eval {

/// How an estimated trajectory compares with a reference.
struct Evaluation {
  ErrorTable raw;      ///< as it is: what a robot on this map would be off by
  ErrorTable aligned;  ///< after the best rigid motion: what is left of it when the map's frame is not
  Pose2 reference_from_estimate;          ///< that motion
  std::vector<PoseError> errors;          ///< one a pair, in order of time, as it is
  std::vector<PoseError> aligned_errors;  ///< the same, aligned
  std::size_t unmatched_count = 0;        ///< estimates without a reference at their stamp

  friend bool operator==(const Evaluation&, const Evaluation&) = default;
};

/// Compares two trajectories of the same body. See associate(), align() and ErrorTable for how.
Evaluation evaluate(const Trajectory& estimate, const Trajectory& reference, double max_gap_s = 1.0);

}  // namespace beaconless::eval
