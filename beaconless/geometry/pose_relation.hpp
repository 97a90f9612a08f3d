// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// Which pose of a drive is meant: the one at a moment, or that of the n-th scan, counted from 0.
using PoseKey = std::variant<Stamp, std::uint64_t>;

/// What somebody knows of two poses of one drive: where the second was, seen from the first.
struct PoseRelation {
  PoseKey from;
  PoseKey to;
  Pose2 from_pose_to;  ///< the pose of `to` in the frame of `from`

  friend bool operator==(const PoseRelation&, const PoseRelation&) = default;
};

}  // namespace beaconless
