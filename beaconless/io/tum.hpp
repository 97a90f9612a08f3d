// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <functional>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::io {

/// Reads a trajectory of TUM lines, `t x y z qx qy qz qw`; `#` begins a comment.
///
/// The pose is projected to the plane: z is dropped, heading is the quaternion's yaw, atan2(2 (w z + x y),
/// 1 - 2 (y² + z²)) after it is made a unit. Lines that are no pose (not eight finite numbers, x or y beyond
/// 1e9 m, a quaternion of no length) go to `on_problem` with their number and are passed over; so is told,
/// and kept, a stamp that is older than the one before. A file without any pose is an Error. Source:
/// cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats.
Result<Trajectory> read_tum(const std::string& path,
                            const std::function<void(const Problem&)>& on_problem = {});

/// Writes the whole trajectory. Nine decimals for time and metres.
Result<Done> write_tum(const std::string& path, const Trajectory& trajectory);

/// Writes TUM lines as they come.
class TumWriter {
 public:
  /// Opens the file; a path that cannot be written shows in `good()`.
  explicit TumWriter(const std::string& path);

  void write(Stamp stamp, const Pose2& pose);
  void write(const PoseEstimate& estimate) { write(estimate.stamp, estimate.map_from_base); }
  bool good() const { return out_.good(); }

  /// Closes the file and says whether every line has reached it.
  Result<Done> finish();

 private:
  std::string path_;
  std::ofstream out_;
};

}  // namespace beaconless::io
