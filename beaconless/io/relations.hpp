// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose_relation.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Reads relations between the poses of a drive: lines `t1 t2 x y z roll pitch yaw` with stamps in seconds,
/// or `i j x y theta` with numbers of scans counted from 0; `#` begins a comment.
///
/// The first line says which of the two the file is. Relations are projected to the plane: z, roll and pitch
/// must be numbers, and are dropped. Lines that are no relation (another number of words, a word that is no
/// finite number or no stamp, further than 1e9 m) go to `on_problem` with their number and are passed over. A
/// file without any relation is an Error. Source: the relations published with Kümmerle et al., "On measuring
/// the accuracy of SLAM algorithms", 2009.
Result<std::vector<PoseRelation>> read_relations(const std::string& path,
                                                 const std::function<void(const Problem&)>& on_problem = {});

}  // namespace beaconless::io
