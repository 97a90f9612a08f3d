// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/local_search.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/match/best_apart.hpp"

namespace beaconless {
namespace {

constexpr double kHopeless = 0.2;  // a start whose cost is so much above the best is not worth following

/// Mean truncated squared distance to the map, 0 … 1; anything above `give_up` where it cannot be below that.
template <SurfaceIndex Index>
double misfit(std::span<const Eigen::Vector2d> arms, const Index& map, const Eigen::Vector2d& origin,
              double truncate_m, double give_up) {
  const double worst = truncate_m * truncate_m;
  const double enough = give_up * worst * static_cast<double>(arms.size());
  double sum = 0.0;
  for (const Eigen::Vector2d& arm : arms) {
    const auto surface = map.nearest(origin + arm);
    sum += surface ? std::min(worst, surface->distance_m * surface->distance_m) : worst;
    if (sum > enough) break;
  }
  return sum / (worst * static_cast<double>(arms.size()));
}

template <SurfaceIndex Index>
std::vector<StartPose> search(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& guess,
                              const LocalSearchConfig& config) {
  if (points.empty()) return {};
  std::vector<Eigen::Vector2d> few;
  thin(points, config.points, few);
  std::vector<Eigen::Vector2d> arms(few.size());
  const int turns = static_cast<int>(std::ceil(config.window_deg / config.step_deg));
  const int moves = static_cast<int>(std::ceil(config.window_m / config.step_m));
  std::vector<StartPose> poses;
  double best_cost = 1.0 + config.far_penalty;
  for (int k = -turns; k <= turns; ++k) {
    const double theta = wrap_angle(guess.theta_rad + radians(k * config.step_deg));
    const Eigen::Matrix2d rotation = Pose2{0.0, 0.0, theta}.rotation();
    std::transform(few.begin(), few.end(), arms.begin(),
                   [&](const auto& p) -> Eigen::Vector2d { return rotation * p; });
    for (int i = -moves; i <= moves; ++i) {
      for (int j = -moves; j <= moves; ++j) {
        const Pose2 pose{guess.x_m + i * config.step_m, guess.y_m + j * config.step_m, theta};
        const double away = std::max(
            {std::abs(k) / std::max(1.0, 1.0 * turns), std::hypot(i, j) / std::max(1.0, 1.0 * moves)});
        const double penalty = config.far_penalty * away * away;
        const double cost = penalty + misfit(std::span<const Eigen::Vector2d>(arms), map, pose.translation(),
                                             config.truncate_m, best_cost + kHopeless - penalty);
        best_cost = std::min(best_cost, cost);
        if (cost <= best_cost + kHopeless) poses.push_back({pose, cost});
      }
    }
  }
  std::vector<StartPose> best;
  keep_best_apart(
      poses, config.step_m, config.step_deg, config.keep,
      [](const StartPose& a, const StartPose& b) { return a.cost < b.cost; }, best);
  return best;
}

}  // namespace

void describe(Fields& fields, LocalSearchConfig& config) {
  fields("window_m", config.window_m, {0.0, 10.0}, "how far to each side starts are tried");
  fields("step_m", config.step_m, {0.005, 1.0}, "distance between starts");
  fields("window_deg", config.window_deg, {0.0, 180.0}, "how far to each side headings are tried");
  fields("step_deg", config.step_deg, {0.1, 30.0}, "angle between headings");
  fields("points", config.points, {10, 10000}, "points of the scan that vote, evenly taken");
  fields("truncate_m", config.truncate_m, {0.01, 10.0},
         "points further from every wall than this all count the same");
  fields("far_penalty", config.far_penalty, {0.0, 10.0}, "cost of a start at the window's edge");
  fields("lost_stride", config.lost_stride, {1, 1000},
         "a lost robot searches, further around, with every so many scans");
  fields("keep", config.keep, {1, 100}, "best starts that are followed up");
}

std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const WallIndex& map,
                                     const Pose2& guess, const LocalSearchConfig& config) {
  return search(points, map, guess, config);
}

std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const CellIndex& map,
                                     const Pose2& guess, const LocalSearchConfig& config) {
  return search(points, map, guess, config);
}

std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                                     const Pose2& guess, const LocalSearchConfig& config) {
  return std::visit([&](const auto& index) { return search(points, index, guess, config); }, map);
}

}  // namespace beaconless
