// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/growing_map.hpp"

#include <cmath>

namespace beaconless {

void describe(Fields& fields, GrowingMapConfig& config) {
  fields("resolution_m", config.resolution_m, {0.005, 1.0}, "side of the finest cells");
  fields("levels", config.levels, {1, 8}, "grids that are matched on, each half as fine as the one before");
  fields("p_occupied", config.p_occupied, {0.51, 0.999},
         "probability that a cell is occupied where a beam ended");
  fields("p_free", config.p_free, {0.001, 0.49},
         "probability that a cell is occupied where a beam went through");
  fields("min_log_odds", config.min_log_odds, {-31.0, -0.1}, "how sure a cell can be of being free");
  fields("max_log_odds", config.max_log_odds, {0.1, 31.0}, "how sure a cell can be of being occupied");
  fields("max_cells", config.max_cells, {1000, 150'000'000},
         "of the finest grid; a scan that needs more is left out of the map");
}

GrowingMap::GrowingMap(const GrowingMapConfig& config) {
  const LogOddsModel model{config.p_occupied, config.p_free, config.min_log_odds, config.max_log_odds};
  const auto levels = static_cast<std::size_t>(config.levels);
  evidence_.reserve(levels);
  pyramid_.levels.reserve(levels);
  double resolution_m = config.resolution_m;
  for (std::size_t i = 0; i < levels; ++i, resolution_m *= 2.0) {
    evidence_.emplace_back(resolution_m, model, config.max_cells);
    pyramid_.levels.emplace_back(resolution_m, Pose2{});
  }
  // Where in its cell a wall runs is forgotten: anywhere is as likely.
  pyramid_.wall_sigma_m = config.resolution_m / std::sqrt(12.0);
}

Result<Done> GrowingMap::add(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways) {
  if (ways.empty()) return Done{};
  // The finest level comes first: where it has room, the others have.
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    LogOddsGrid& evidence = evidence_[i];
    OccupancyLevel& level = pyramid_.levels[i];
    if (auto room = evidence.cover(laser_map, ways); !room) return room;
    const LogOddsGrid::Box& box = evidence.room();
    if (auto room = level.cover(box.low, {box.high.x - 1, box.high.y - 1}); !room) return room;
    auto added = evidence.add(laser_map, ways, [&](Cell cell, int before, int now) {
      if (before < 0 && now <= 0) return;  // free it was, free it is
      level.set(cell, OccupancyLevel::value_of(LogOddsGrid::probability(now)));
    });
    if (!added) return added;
  }
  ++scan_count_;
  return Done{};
}

}  // namespace beaconless
