// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "beaconless/io/pose_saver.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless::ros1 {

/// The file in which a robot keeps its last good pose over being switched off; without a path it does
/// nothing.
class PoseMemory {
 public:
  explicit PoseMemory(std::string path) : path_(std::move(path)) {}

  void set_map(const io::MapIdentity& map);

  /// The pose in the file; nothing where there is no file. Errors: it cannot be read, or is of another map.
  Result<std::optional<Pose2>> recall() const;

  /// Errors: those of writing.
  Result<Done> update(const PoseEstimate& estimate);
  Result<Done> finish();

 private:
  std::string path_;
  std::optional<io::MapIdentity> map_;
  std::optional<io::PoseSaver> saver_;
};

/// Which map it is that came by a topic: the same cells are the same map.
io::MapIdentity identify_grid(const OccupancyGrid& grid);

}  // namespace beaconless::ros1
