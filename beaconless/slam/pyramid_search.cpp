// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/pyramid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/match/best_apart.hpp"
#include "beaconless/slam/level_reader.hpp"

namespace beaconless {
namespace {

constexpr double kHopeless = 0.3;  // a pose whose score is so much below the best is not worth following
constexpr int kFree = -127;        // in 1/254

/// What a point counts for that falls into a cell, in 1/254, by the cell's byte.
constexpr std::array<int, 256> kScore = [] {
  std::array<int, 256> score{};
  for (int byte = 1; byte < 255; ++byte) score[static_cast<std::size_t>(byte)] = byte;
  score[0] = kFree;
  score[OccupancyLevel::kUnknown] = 0;
  return score;
}();

/// The mean over the cells: M on obstacles, kFree where nothing stands, 0 where nothing is known.
double score_of(const std::vector<Cell>& cells, const LevelReader& level, int dx, int dy) {
  int sum = 0;
  for (const Cell& cell : cells) sum += kScore[level.byte({cell.x + dx, cell.y + dy})];
  return sum / (254.0 * static_cast<double>(cells.size()));
}

}  // namespace

void describe(Fields& fields, PyramidSearchConfig& config) {
  fields("window_m", config.window_m, {0.0, 10.0}, "how far to each side poses are tried");
  fields("window_deg", config.window_deg, {0.0, 180.0}, "how far to each side headings are tried");
  fields("step_deg", config.step_deg, {0.1, 30.0}, "angle between headings");
  fields("points", config.points, {10, 10000}, "points of the scan that vote, evenly taken");
  fields("far_penalty", config.far_penalty, {0.0, 10.0},
         "share of the scan that a pose at the window's edge must fit better by");
  fields("keep", config.keep, {1, 100}, "best poses that are followed up");
}

void search_pyramid(std::span<const Eigen::Vector2d> points, const OccupancyLevel& level, const Pose2& guess,
                    const PyramidSearchConfig& config, PyramidSearchScratch& scratch,
                    std::vector<FoundPose>& found) {
  found.clear();
  scratch.tried.clear();
  if (points.empty()) return;
  thin(points, config.points, scratch.points);
  const double step_m = level.resolution_m();
  const Pose2 grid_from_laser = level.map_from_grid().inverse() * guess;
  const int turns = static_cast<int>(std::ceil(config.window_deg / config.step_deg));
  const int moves = static_cast<int>(std::ceil(config.window_m / step_m));
  const LevelReader reader(level);
  double best = -1.0;
  for (int k = -turns; k <= turns; ++k) {
    const double theta = wrap_angle(grid_from_laser.theta_rad + radians(k * config.step_deg));
    const Eigen::Matrix2d rotation = Pose2{0.0, 0.0, theta}.rotation() / step_m;
    const Eigen::Vector2d origin = grid_from_laser.translation() / step_m;
    scratch.cells.clear();
    for (const Eigen::Vector2d& point : scratch.points)
      scratch.cells.push_back(cell_of(origin + rotation * point));
    for (int dx = -moves; dx <= moves; ++dx) {
      for (int dy = -moves; dy <= moves; ++dy) {
        const double turned = std::abs(k) / std::max(1.0, 1.0 * turns);
        const double moved = std::hypot(dx, dy) / std::max(1.0, 1.0 * moves);
        const double away = std::max(turned, moved);
        const double score = score_of(scratch.cells, reader, dx, dy) - config.far_penalty * away * away;
        best = std::max(best, score);
        if (score < best - kHopeless) continue;
        const Pose2 grid_pose{grid_from_laser.x_m + dx * step_m, grid_from_laser.y_m + dy * step_m, theta};
        scratch.tried.push_back({level.map_from_grid() * grid_pose, score});
      }
    }
  }
  keep_best_apart(
      scratch.tried, step_m, config.step_deg, config.keep,
      [](const FoundPose& a, const FoundPose& b) { return a.score > b.score; }, found);
}

}  // namespace beaconless
