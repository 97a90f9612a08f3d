// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/io/map_identity.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// The pose to go on from, by the file of `--start resume:FILE`; one that is old is told to be so.
///
/// Errors: those of read_last_pose, and a pose on another map than the one at hand.
Result<Pose2> resumed_pose(const Console& console, const std::string& pose_file, const io::MapIdentity& map,
                           Stamp first_scan);

}  // namespace beaconless::cli
