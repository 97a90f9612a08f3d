// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/io/recording.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// Poses of the robot that come with a recording or beside it.
struct PosesOf {
  std::string source;  ///< a file, a topic, or a keyword of a log
  Trajectory trajectory;
  std::vector<std::optional<Pose2>> by_scan;  ///< for each scan of the recording, where its own line says so
  std::optional<Pose2> base_from_laser;       ///< where the recording tells laser and robot apart

  /// Whether it tells that the laser sits a centimetre or more beside the base.
  bool tells_laser_apart() const;

  /// The pose at a scan: its own, else the trajectory's at its stamp.
  std::optional<Pose2> at(std::size_t scan_index, Stamp stamp) const;
};

/// Reads poses from a TUM file, or, for the word "recorded", from the recording itself.
///
/// Of the sources inside a recording the one named `topic` is taken; without a name, the pose fields of the
/// scan lines, else the only reference topic, else the only odometry. Errors: none there, several and none
/// named (all are listed). Lines of the TUM file that are no pose go to `problems`.
Result<PosesOf> poses_of(const std::string& tum_or_recorded, const io::Recording& recording,
                         const std::string& topic, ProblemLog& problems);

}  // namespace beaconless::cli
