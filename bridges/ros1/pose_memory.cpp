// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/pose_memory.hpp"

#include <filesystem>

#include <fmt/format.h>

namespace beaconless::ros1 {

void PoseMemory::set_map(const io::MapIdentity& map) {
  map_ = map;
  if (!path_.empty()) saver_.emplace(path_, map);
}

Result<std::optional<Pose2>> PoseMemory::recall() const {
  if (path_.empty() || !map_ || !std::filesystem::exists(path_)) return std::optional<Pose2>{};
  const auto last = io::read_last_pose(path_);
  if (!last) return last.error();
  if (auto same = io::check_map(*last, path_, *map_); !same) return same.error();
  return std::optional(last->map_from_base);
}

Result<Done> PoseMemory::update(const PoseEstimate& estimate) {
  return saver_ ? saver_->update(estimate) : Done{};
}

Result<Done> PoseMemory::finish() { return saver_ ? saver_->finish() : Done{}; }

io::MapIdentity identify_grid(const OccupancyGrid& grid) {
  const Pose2& at = grid.map_from_grid;
  const std::string head = fmt::format("{} {} {} {} {} {}", grid.width_cells, grid.height_cells,
                                       grid.resolution_m, at.x_m, at.y_m, at.theta_rad);
  const auto* const cells = reinterpret_cast<const char*>(grid.occupancy_percent.data());
  return {"topic map", io::fnv1a({cells, grid.occupancy_percent.size()}, io::fnv1a(head))};
}

}  // namespace beaconless::ros1
