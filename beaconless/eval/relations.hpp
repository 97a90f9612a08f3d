// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/eval/errors.hpp"
#include "beaconless/geometry/pose_relation.hpp"
#include "beaconless/geometry/trajectory.hpp"

namespace beaconless::eval {

/// How the two ends of a relation find their poses.
struct RelationKeys {
  double tolerance_s = 0.1;        ///< a pose further from the stamp that is asked for is not the one meant
  double clock_offset_s = 0.0;     ///< how far the relations' clock is ahead of the trajectory's
  std::vector<Stamp> scan_stamps;  ///< of the scans that relations count, on the trajectory's clock; empty:
                                   ///< the n-th scan is that of the n-th pose
};

/// The error of one relation.
struct RelationError {
  std::size_t index = 0;  ///< of the relation, from 0
  double translation_m = 0.0;
  double rotation_deg = 0.0;  ///< absolute

  friend bool operator==(const RelationError&, const RelationError&) = default;
};

/// How a trajectory keeps the relations that are known of it.
struct RelationEvaluation {
  std::vector<RelationError> errors;   ///< in the order of the relations
  Statistics translation_m;            ///< of the errors
  Statistics rotation_deg;             ///< likewise
  std::size_t relation_count = 0;      ///< all that were asked for
  std::size_t without_pose_count = 0;  ///< of them, those that lack a pose at one end or both

  friend bool operator==(const RelationEvaluation&, const RelationEvaluation&) = default;
};

/// Compares the motion between pairs of poses with what is known of it. No common frame is needed, and an
/// error in one place of a drive counts only where it happened.
///
/// With d = from⁻¹ to of the trajectory and d* of the relation, errors are the length and the turn of
/// d*⁻¹ d. An end by stamp takes the nearest pose in time within the tolerance (not one between two:
/// relations are of scans); an end by scan takes the pose of that scan. Relations without both poses are
/// counted, never guessed. Cost: O(relations x log poses).
///
/// Source: Kümmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 27(4), 2009,
/// eq. 4 with absolute values, as its tables have them.
RelationEvaluation evaluate_relations(const Trajectory& estimate, std::span<const PoseRelation> relations,
                                      const RelationKeys& keys = {});

}  // namespace beaconless::eval
