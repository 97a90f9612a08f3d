// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/geometry/trajectory.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// The words of `evaluate --relations`.
struct RelationWords {
  std::string estimate;   ///< path of the trajectory, for messages
  std::string relations;  ///< path
  std::string recording;  ///< whose scans the relations count; "": the n-th scan is that of the n-th pose
  std::string topic;
  double clock_offset_s = 0.0;
  double tolerance_s = 0.1;
};

/// Compares a trajectory with relations of its poses, tells the result, and gives the exit code.
int evaluate_relations(const Console& console, const RelationWords& words, const Trajectory& estimate);

}  // namespace beaconless::cli
