// SPDX-License-Identifier: Apache-2.0
#include "bench/warehouse.hpp"

#include <cmath>

#include "beaconless/core/rng.hpp"
#include "beaconless/sim/scenario.hpp"

namespace beaconless::bench {
namespace {

constexpr double kPitchX_m = 70.0;  // from one hall of a site to the next
constexpr double kPitchY_m = 50.0;

FloorPlan::Polyline box(const Eigen::Vector2d& low, const Eigen::Vector2d& size) {
  const Eigen::Vector2d high = low + size;
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
}

/// A box turned about its center.
FloorPlan::Polyline turned_box(const Pose2& map_from_box, const Eigen::Vector2d& size) {
  FloorPlan::Polyline corners = box(-0.5 * size, size);
  for (Eigen::Vector2d& corner : corners) corner = map_from_box * corner;
  return corners;
}

/// One block of a double rack: nine bays between uprights, and a panel along the middle of it.
void add_rack(FloorPlan& plan, double x, double y) {
  constexpr int kFrames = 10;
  constexpr double kBay_m = 2.5;
  constexpr double kDepth_m = 2.2;
  const Eigen::Vector2d upright(0.10, 0.12);
  for (int frame = 0; frame < kFrames; ++frame) {
    plan.walls.push_back(box({x + kBay_m * frame, y}, upright));
    plan.walls.push_back(box({x + kBay_m * frame, y + kDepth_m - upright.y()}, upright));
  }
  plan.walls.push_back(
      {{x, y + 0.5 * kDepth_m}, {x + kBay_m * (kFrames - 1) + upright.x(), y + 0.5 * kDepth_m}});
}

Drive drive_of(const std::string& name, const FloorPlan& plan, const sim::Path& path, double duration_s) {
  sim::Scenario scenario;
  scenario.plan = plan;
  scenario.lidar.sweep = sim::Sweep::instantaneous;
  scenario.path = path;
  scenario.duration_s = duration_s;
  Drive drive{.name = name, .plan = plan, .base_from_laser = scenario.base_from_laser};
  sim::simulate(scenario, [&drive](const sim::Sample& sample) {
    drive.scans.emplace_back(Scan::make(sample.scan).value());
    drive.truth.add(sample.scan.stamp, sample.map_from_base);
  }).value();
  return drive;
}

}  // namespace

FloorPlan warehouse() {
  FloorPlan plan;
  plan.walls.push_back(box({0.0, 0.0}, {60.0, 40.0}));
  for (int row = 0; row < 6; ++row)
    for (const double x : {5.0, 32.4}) add_rack(plan, x, 3.0 + 6.0 * row);
  for (const double x : {29.0, 30.0, 31.0}) plan.walls.push_back(box({x, 38.0}, {0.4, 0.4}));
  return plan;
}

Eigen::Vector2d hall_at(int halls_a_side, int column, int row) {
  return {kPitchX_m * (column - halls_a_side / 2), kPitchY_m * (row - halls_a_side / 2)};
}

FloorPlan warehouses(int halls_a_side) {
  const FloorPlan one = warehouse();
  FloorPlan plan;
  for (int row = 0; row < halls_a_side; ++row)
    for (int column = 0; column < halls_a_side; ++column)
      for (FloorPlan::Polyline wall : one.walls) {
        for (Eigen::Vector2d& corner : wall) corner += hall_at(halls_a_side, column, row);
        plan.walls.push_back(std::move(wall));
      }
  return plan;
}

Drive warehouse_drive() {
  sim::Waypoints way;
  way.points = {{2.5, 7.1}, {30.5, 7.1}, {30.5, 13.1}, {2.5, 13.1}, {2.5, 7.1}};
  way.speed_mps = 1.2;
  return drive_of("warehouse", warehouse(), way, 60.0);
}

Drive furnished_room_drive() {
  FloorPlan plan;
  plan.walls.push_back(box({0.0, 0.0}, {12.0, 8.0}));
  Rng rng(5);
  for (int piece = 0; piece < 22; ++piece) {
    // Around the ellipse, none nearer to it than a metre.
    const double angle = 2.0 * kPi * piece / 22.0;
    const Pose2 map_from_piece{6.0 + 5.2 * std::cos(angle), 4.0 + 3.4 * std::sin(angle),
                               rng.uniform(-kPi, kPi)};
    plan.walls.push_back(turned_box(map_from_piece, {rng.uniform(0.1, 0.8), rng.uniform(0.1, 0.5)}));
  }
  sim::Ellipse way;
  way.center_x_m = 6.0;
  way.center_y_m = 4.0;
  way.semi_axis_x_m = 3.0;
  way.semi_axis_y_m = 1.5;
  return drive_of("furnished-room", plan, way, 30.0);
}

}  // namespace beaconless::bench
