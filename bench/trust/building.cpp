// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/building.hpp"

#include "bench/trust/outlines.hpp"

namespace beaconless::trust {
namespace {

FloorPlan::Polyline piece(const Eigen::Vector2d& at, double turn_rad, Rng& rng) {
  const Eigen::Vector2d size(rng.uniform(0.15, 1.2), rng.uniform(0.15, 0.8));
  return carried(rectangle_at(-0.5 * size, size), {at.x(), at.y(), turn_rad});
}

int count(Rng& rng, double from, double to) { return static_cast<int>(rng.uniform(from, to + 1.0)); }

/// One room, plain or with a corner cut out, and things all over it.
Building room(Rng& rng) {
  const Eigen::Vector2d size(rng.uniform(6.0, 16.0), rng.uniform(5.0, 12.0));
  Building building;
  if (rng.uniform() < 0.5) {
    building.walls.push_back(rectangle_at({0, 0}, size));
  } else {
    const double x = size.x() * rng.uniform(0.5, 0.85);
    const double y = size.y() * rng.uniform(0.5, 0.85);
    building.walls.push_back(
        {{0, 0}, {size.x(), 0}, {size.x(), y}, {x, y}, {x, size.y()}, {0, size.y()}, {0, 0}});
  }
  const int pieces = count(rng, 5, 18);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d at(size.x() * rng.uniform(0.02, 0.98), size.y() * rng.uniform(0.02, 0.98));
    building.furniture.push_back(piece(at, rng.uniform() < 0.5 ? 0.0 : rng.uniform(-kPi, kPi), rng));
  }
  return building;
}

/// A block of racks: uprights at even distances, some with a back.
void add_rack(Building& building, const Eigen::Vector2d& at, int bays, double bay_m, bool has_back) {
  constexpr double kDepth_m = 1.1;
  const Eigen::Vector2d upright(0.10, 0.12);
  for (int i = 0; i <= bays; ++i)
    for (const double y : {0.0, kDepth_m - upright.y()})
      building.walls.push_back(rectangle_at(at + Eigen::Vector2d(bay_m * i, y), upright));
  if (!has_back) return;
  const double y = at.y() + 0.5 * kDepth_m;
  building.walls.push_back({{at.x(), y}, {at.x() + bay_m * bays + upright.x(), y}});
}

/// A hall of racks that repeat, and a few pallets.
Building racks(Rng& rng) {
  const double bay_m = rng.uniform(1.2, 2.7);
  const double aisle_m = rng.uniform(2.2, 3.5);
  const int rows = count(rng, 3, 8);
  const int bays = count(rng, 5, 14);
  const bool has_back = rng.uniform() < 0.6;
  const double cross_m = rng.uniform(2.5, 4.0);
  const int blocks = bay_m * bays > 20.0 ? 1 : 2;
  const Eigen::Vector2d size(cross_m * (blocks + 1) + bay_m * bays * blocks,
                             aisle_m + (aisle_m + 1.1) * rows);
  Building building;
  building.walls.push_back(rectangle_at({0, 0}, size));
  for (int row = 0; row < rows; ++row)
    for (int block = 0; block < blocks; ++block)
      add_rack(building, {cross_m + block * (cross_m + bay_m * bays), aisle_m + row * (aisle_m + 1.1)}, bays,
               bay_m, has_back);
  const int pallets = count(rng, 2, 12);
  for (int i = 0; i < pallets; ++i)
    building.furniture.push_back(piece({size.x() * rng.uniform(), size.y() * rng.uniform()}, 0.0, rng));
  return building;
}

/// From a to b with shallow recesses, as doors make them, to the right of the way.
void add_side(FloorPlan::Polyline& outline, const Eigen::Vector2d& a, const Eigen::Vector2d& b, Rng& rng) {
  const double length = (b - a).norm();
  const Eigen::Vector2d along = (b - a) / length;
  const Eigen::Vector2d outward(along.y(), -along.x());
  outline.push_back(a);
  for (double at = rng.uniform(0.8, 4.0); at + 1.4 < length; at += rng.uniform(1.6, 9.0)) {
    const double depth = rng.uniform(0.05, 0.35);
    const double width = rng.uniform(0.8, 1.1);
    for (const auto& [way, out] : {std::pair{at, 0.0}, {at, depth}, {at + width, depth}, {at + width, 0.0}})
      outline.push_back(a + way * along + out * outward);
  }
}

/// A corridor, straight or around a corner, with doors and a few cabinets.
Building corridor(Rng& rng) {
  const double length = rng.uniform(20.0, 60.0);
  const double width = rng.uniform(1.8, 3.0);
  std::vector<Eigen::Vector2d> corners;
  if (rng.uniform() < 0.5) {
    corners = {{0, 0}, {length, 0}, {length, width}, {0, width}};
  } else {
    const double up = rng.uniform(8.0, 30.0);
    corners = {{0, 0}, {length, 0}, {length, up}, {length - width, up}, {length - width, width}, {0, width}};
  }
  FloorPlan::Polyline outline;
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_side(outline, corners[i], corners[(i + 1) % corners.size()], rng);
  outline.push_back(outline.front());
  Building building;
  building.walls.push_back(outline);
  const int cabinets = count(rng, 0, 5);
  for (int i = 0; i < cabinets; ++i)
    building.furniture.push_back(
        rectangle_at({length * rng.uniform(0.05, 0.9), 0.0}, {rng.uniform(0.4, 1.2), 0.4}));
  return building;
}

/// A row of rooms along one side of a corridor, each with a door to it.
void add_offices(Building& building, double length, double door_y, double far_y, Rng& rng) {
  constexpr double kThick_m = 0.12;  // more than what is called wrong
  const double out = far_y > door_y ? kThick_m : -kThick_m;
  double x = 0.0;
  while (x < length - 2.6) {
    const double end = x + rng.uniform(3.0, 6.5) > length - 2.6 ? length : x + rng.uniform(3.0, 6.5);
    const double door = rng.uniform(1.0, 1.2);
    const double at = rng.uniform(x + 0.4, end - 0.4 - door);
    for (const auto& [from, to] : {std::pair{x, at}, {at + door, end}})
      building.walls.push_back(rectangle_at({from, std::min(door_y, door_y + out)}, {to - from, kThick_m}));
    if (end < length) building.walls.push_back({{end, door_y + out}, {end, far_y}});
    const int pieces = count(rng, 1, 5);
    for (int i = 0; i < pieces; ++i) {
      const Eigen::Vector2d place(rng.uniform(x + 0.3, end - 0.3),
                                  door_y + rng.uniform(0.35, 0.95) * (far_y - door_y));
      building.furniture.push_back(piece(place, 0.0, rng));
    }
    x = end;
  }
}

/// Offices on both sides of a corridor.
Building offices(Rng& rng) {
  const double length = rng.uniform(12.0, 50.0);
  const double below = rng.uniform(3.5, 6.0);
  const double width = rng.uniform(1.8, 2.6);
  const double above = rng.uniform(3.5, 6.0);
  Building building;
  building.walls.push_back(rectangle_at({0, 0}, {length, below + width + above}));
  add_offices(building, length, below, 0.0, rng);
  add_offices(building, length, below + width, below + width + above, rng);
  return building;
}

}  // namespace

FloorPlan Building::plan() const {
  FloorPlan plan{.walls = walls};
  plan.walls.insert(plan.walls.end(), furniture.begin(), furniture.end());
  return plan;
}

bool Building::is_inside(const Eigen::Vector2d& point) const {
  const FloorPlan::Polyline& outline = walls.front();
  bool is_inside = false;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[i + 1];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) is_inside = !is_inside;
  }
  return is_inside;
}

Building make_building(Family family, Rng& rng) {
  Building building = family == Family::room       ? room(rng)
                      : family == Family::racks    ? racks(rng)
                      : family == Family::corridor ? corridor(rng)
                                                   : offices(rng);
  const Pose2 map_from_drawing{0.0, 0.0, rng.uniform() < 0.3 ? 0.0 : rng.uniform(-kPi, kPi)};
  for (auto* lines : {&building.walls, &building.furniture})
    for (FloorPlan::Polyline& line : *lines) line = carried(std::move(line), map_from_drawing);
  building.heading_rad = map_from_drawing.theta_rad;
  return building;
}

}  // namespace beaconless::trust
