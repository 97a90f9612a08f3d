// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/overlap.hpp"

#include <algorithm>
#include <cstdint>

#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/slam/level_reader.hpp"

namespace beaconless {
namespace {

constexpr double kObstacle = 0.3;  // M of a cell that counts as one: p = 0.65
constexpr double kFarthest_cells = 1e9;

}  // namespace

Overlap overlap_of(std::span<const Eigen::Vector2d> points, const OccupancyLevel& level,
                   const Pose2& map_from_laser) {
  const Pose2 grid_from_laser = level.map_from_grid().inverse() * map_from_laser;
  const Eigen::Matrix2d rotation = grid_from_laser.rotation() / level.resolution_m();
  const Eigen::Vector2d origin =
      grid_from_laser.translation() / level.resolution_m() - Eigen::Vector2d(0.5, 0.5);
  const LevelReader reader(level);
  int on = 0;
  int off = 0;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d place = origin + rotation * point;
    if (!(place.cwiseAbs().maxCoeff() < kFarthest_cells)) continue;
    // The four cells whose middles are around the point.
    std::uint32_t word = reader.word(cell_of(place));
    std::uint32_t highest = 0;
    bool is_all_known = true;
    for (int i = 0; i < 4; ++i, word >>= 8U) {
      const std::uint32_t byte = word & 0xffU;
      is_all_known = is_all_known && byte != OccupancyLevel::kUnknown;
      if (byte != OccupancyLevel::kUnknown) highest = std::max(highest, byte);
    }
    if (highest >= kObstacle)
      ++on;
    else if (is_all_known)
      ++off;
  }
  const double all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return {on / all, off / all};
}

}  // namespace beaconless
