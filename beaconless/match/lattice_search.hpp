// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/nearness_pyramid.hpp"

namespace beaconless {

/// A pose worth starting from.
struct StartPose {
  Pose2 map_from_laser;
  double cost =
      0.0;  ///< 0 where all points are on surfaces, 1 where none is near any, and what being far adds
};

/// Poses at even distances around a middle one: a cell of the map apart, and `step_rad`.
struct PoseLattice {
  Pose2 middle;
  int moves_x = 0;  ///< cells to each side
  int moves_y = 0;
  int turns = 0;  ///< headings to each side
  double step_rad = 0.0;
  double far_penalty = 0.0;  ///< what is added to the cost at the edge; it grows with the square of the way
};

/// Which poses of a lattice are wanted.
struct LatticeWish {
  int keep = 1;            ///< this many at most …
  double hopeless = 1.0;   ///< … whose cost is at most so much above the best …
  double apart_m = 0.0;    ///< … and that are this far from any better one …
  double apart_rad = 0.0;  ///< … or turned this far
  int threads = 1;         ///< that share the work where the lattice is wide; what is found is the same
};

/// Buffers that live on from call to call, so that a search allocates nothing.
struct LatticeScratch {
  /// Poses of one heading in a block of the map's.
  struct Block {
    int cost = 0;  ///< that none of its poses is below
    int level = 0;
    int heading = 0;
    int x = 0;  ///< its first pose, in cells from the first of the lattice
    int y = 0;
  };
  std::vector<Cell> cells;                 ///< those of the points at the first pose of each heading
  std::vector<std::vector<Block>> blocks;  ///< of each thread
};

/// The poses of a lattice at which points fall nearest to the map's surfaces: the best, the best of those
/// apart from it, and so on, best first.
///
/// Exact: the same as if every pose was tried, ties going to the first heading, then y, then x; the cost is
/// the mean of 1 - nearness / kOnSurface over the points' cells. In: at most TileSums::kMostCells points, in
/// the laser frame; a finite lattice. Cost: points x headings x blocks of the whole lattice, 64 at once, and
/// a few hundred blocks that are looked into; of a wide lattice all that are not hopeless, four at once.
/// Source: Hess et al., ICRA 2016, V-B (branch and bound over headings and blocks of positions, points turned
/// once a heading). Differs: best first instead of depth first, which gives the second best too.
void search_lattice(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                    const PoseLattice& lattice, const LatticeWish& wish, LatticeScratch& scratch,
                    std::vector<StartPose>& found);

}  // namespace beaconless
