// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/lattice_bounds.hpp"

#include "beaconless/map/grid_traversal.hpp"

namespace beaconless {

LatticeBounds::LatticeBounds(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                             const PoseLattice& lattice, std::vector<Cell>& cells)
    : points_(points.size()),
      map_(map),
      lattice_(lattice),
      columns_(2 * lattice.moves_x + 1),
      rows_(2 * lattice.moves_y + 1),
      worst_(NearnessPyramid::kOnSurface * static_cast<int>(points.size())),
      per_move2_(penalty_per_step2(std::max(lattice.moves_x, lattice.moves_y))),
      per_turn2_(penalty_per_step2(lattice.turns)) {
  turn(points, cells);
  cells_ = cells;
}

/// The cells of the points at every heading, as seen from the lattice's first pose.
void LatticeBounds::turn(std::span<const Eigen::Vector2d> points, std::vector<Cell>& cells) const {
  constexpr std::size_t kApart = 8;
  constexpr double kFar = 1e8;  // cells; nothing is there, but numbers stay those of an int
  const Eigen::Vector2d first = (lattice_.middle.translation() - map_.low()) / map_.cell_m() -
                                Eigen::Vector2d(lattice_.moves_x, lattice_.moves_y);
  cells.clear();
  for (int heading = 0; heading < headings(); ++heading) {
    const Eigen::Matrix2d rotation = Pose2{0.0, 0.0, theta_of(heading)}.rotation() / map_.cell_m();
    // Neighbours apart, so that any few of them are of the whole scan and tell soon that it does not fit.
    for (std::size_t begin = 0; begin < kApart; ++begin)
      for (std::size_t i = begin; i < points.size(); i += kApart)
        cells.push_back(cell_of((first + rotation * points[i]).cwiseMax(-kFar).cwiseMin(kFar)));
  }
}

float LatticeBounds::penalty_per_step2(int steps) const {
  const int most = std::max(1, steps);
  return static_cast<float>(lattice_.far_penalty * worst_) / static_cast<float>(most * most);
}

}  // namespace beaconless
