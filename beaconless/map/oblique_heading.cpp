// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/oblique_heading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr int kHeadings = 180;
constexpr int kLongestStep_cells = 4;

/// A direction in which the cells of a grid form rows: along the grid's own rows, its diagonals, …
struct LatticeRow {
  double direction_rad;
  double spacing_cells;  // between one such row and the next
};

std::vector<LatticeRow> lattice_rows() {
  std::vector<LatticeRow> rows;
  rows.reserve(std::size_t{2} * kLongestStep_cells * kLongestStep_cells);
  for (int x = 0; x <= kLongestStep_cells; ++x)
    for (int y = x == 0 ? 1 : -kLongestStep_cells; y <= kLongestStep_cells; ++y)
      if (std::gcd(x, y) == 1) rows.push_back({std::atan2(y, x), 1.0 / std::hypot(x, y)});
  return rows;
}

/// By how many cells a wall is off when drawn, about: half the spacing of the lattice rows it runs along,
/// less if it crosses many of them.
double offset_cells(double direction_rad, double length_cells, const std::vector<LatticeRow>& rows) {
  double most = 0.0;
  for (const LatticeRow& row : rows) {
    const double crossed = length_cells * std::abs(std::sin(direction_rad - row.direction_rad));
    most = std::max(most, 0.5 * row.spacing_cells * std::min(1.0, row.spacing_cells / crossed));
  }
  return most;
}

}  // namespace

double oblique_heading_rad(const FloorPlan& plan, double resolution_m) {
  const std::vector<Segment2> walls = plan.segments();
  if (walls.empty() || !(resolution_m > 0.0)) return 0.0;
  const std::vector<LatticeRow> rows = lattice_rows();
  double best_rad = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kHeadings; ++i) {
    const double heading_rad = 0.5 * kPi * i / kHeadings;
    double cost = 0.0;
    for (const Segment2& wall : walls) {
      const Eigen::Vector2d way = wall.b - wall.a;
      const double length_cells = way.norm() / resolution_m;
      const double offset = offset_cells(std::atan2(way.y(), way.x()) - heading_rad, length_cells, rows);
      cost += length_cells * offset * offset;
    }
    if (cost < least) {
      least = cost;
      best_rad = heading_rad;
    }
  }
  return best_rad;
}

}  // namespace beaconless
