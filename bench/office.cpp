// SPDX-License-Identifier: Apache-2.0
#include "bench/office.hpp"

#include <algorithm>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless::bench {
namespace {

constexpr double kCorridor_m = 2.4;
constexpr double kRoom_m = 5.0;
constexpr double kDoor_m = 0.9;

FloorPlan::Polyline box(const Eigen::Vector2d& low, const Eigen::Vector2d& size) {
  const Eigen::Vector2d high = low + size;
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
}

/// What stands in a room, along its back wall and in its middle.
void furnish(FloorPlan& plan, double left, double right, double back, double towards_door, Rng& rng) {
  const double cupboard = std::min(right - left - 0.4, rng.uniform(0.6, 2.0));
  const double at = rng.uniform(left + 0.1, right - cupboard - 0.1);
  plan.walls.push_back(box({at, back + (towards_door > 0.0 ? 0.05 : -0.5)}, {cupboard, 0.45}));
  const Eigen::Vector2d desk(rng.uniform(0.7, 1.6), rng.uniform(0.6, 0.9));
  const double in = rng.uniform(1.3, 2.8);
  plan.walls.push_back(box({rng.uniform(left + 0.1, std::max(left + 0.2, right - desk.x() - 0.1)),
                            towards_door > 0.0 ? back + in : back - in - desk.y()},
                           desk));
}

/// Rooms side by side between a corridor's wall at `front` and the wall at `back`.
void add_rooms(FloorPlan& plan, double width, double front, double back, Rng& rng) {
  for (double left = 0.0; left < width;) {
    double right = left + rng.uniform(2.6, 7.0);
    if (width - right < 2.6) right = width;
    const double door = rng.uniform(left + 0.2, right - kDoor_m - 0.2);
    plan.walls.push_back({{left, front}, {door, front}});
    plan.walls.push_back({{door + kDoor_m, front}, {right, front}});
    if (right < width) plan.walls.push_back({{right, front}, {right, back}});
    furnish(plan, left, right, back, front - back, rng);
    left = right;
  }
}

}  // namespace

FloorPlan office(const Eigen::Vector2d& size_m, std::uint64_t seed) {
  constexpr double kWing_m = 2.0 * kRoom_m + kCorridor_m;
  Rng rng(seed);
  FloorPlan plan;
  const int wings = std::max(1, static_cast<int>(size_m.y() / kWing_m));
  const double pitch = size_m.y() / wings;
  plan.walls.push_back(box({0.0, 0.0}, size_m));
  for (int wing = 0; wing < wings; ++wing) {
    const double low = wing * pitch;
    const double middle = low + 0.5 * pitch;
    if (wing > 0) plan.walls.push_back({{0.0, low}, {size_m.x(), low}});
    add_rooms(plan, size_m.x(), middle - 0.5 * kCorridor_m, low, rng);
    add_rooms(plan, size_m.x(), middle + 0.5 * kCorridor_m, low + pitch, rng);
  }
  return plan;
}

}  // namespace beaconless::bench
