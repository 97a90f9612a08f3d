// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/lattice_search.hpp"

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/grid_traversal.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

struct Tried {
  Pose2 pose;
  int cost = 0;
};

/// Every pose of the lattice, in the order in which they are to be preferred.
std::vector<Tried> try_all(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                           const PoseLattice& lattice) {
  const int worst = NearnessPyramid::kOnSurface * static_cast<int>(points.size());
  const auto penalty = [&](int steps2, int most) {
    const int edge = std::max(1, most);
    return static_cast<int>(static_cast<float>(lattice.far_penalty * worst) /
                            static_cast<float>(edge * edge) * static_cast<float>(steps2));
  };
  const Eigen::Vector2d first = (lattice.middle.translation() - map.low()) / map.cell_m() -
                                Eigen::Vector2d(lattice.moves_x, lattice.moves_y);
  std::vector<Tried> all;
  for (int k = -lattice.turns; k <= lattice.turns; ++k) {
    const double theta = wrap_angle(lattice.middle.theta_rad + k * lattice.step_rad);
    std::vector<Cell> cells;
    for (const Eigen::Vector2d& point : points)
      cells.push_back(cell_of(first + Pose2{0.0, 0.0, theta}.rotation() / map.cell_m() * point));
    for (int j = -lattice.moves_y; j <= lattice.moves_y; ++j)
      for (int i = -lattice.moves_x; i <= lattice.moves_x; ++i) {
        int cost = worst + std::max(penalty(k * k, lattice.turns),
                                    penalty(i * i + j * j, std::max(lattice.moves_x, lattice.moves_y)));
        for (const Cell& cell : cells) {
          const std::uint8_t* at = map.tile(0, {cell.x + i + lattice.moves_x, cell.y + j + lattice.moves_y});
          cost -= at == nullptr ? 0 : *at;
        }
        all.push_back(
            {{lattice.middle.x_m + i * map.cell_m(), lattice.middle.y_m + j * map.cell_m(), theta}, cost});
      }
  }
  std::stable_sort(all.begin(), all.end(), [](const Tried& a, const Tried& b) { return a.cost < b.cost; });
  return all;
}

std::vector<StartPose> best_of(const std::vector<Tried>& all, std::size_t points, const LatticeWish& wish) {
  const int worst = NearnessPyramid::kOnSurface * static_cast<int>(points);
  std::vector<StartPose> best;
  for (const Tried& tried : all) {
    if (best.size() == static_cast<std::size_t>(wish.keep) ||
        tried.cost > all.front().cost + static_cast<int>(wish.hopeless * worst))
      break;
    const bool is_neighbour = std::any_of(best.begin(), best.end(), [&](const StartPose& better) {
      return (tried.pose.translation() - better.map_from_laser.translation()).squaredNorm() <
                 wish.apart_m * wish.apart_m &&
             heading_difference_rad(tried.pose, better.map_from_laser) < wish.apart_rad;
    });
    if (!is_neighbour) best.push_back({tried.pose, static_cast<double>(tried.cost) / worst});
  }
  return best;
}

TEST(LatticeSearch, FindsWhatTryingEveryPoseFinds) {
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const NearnessPyramid map{SurfaceMap(WallIndex(plan))};
  Rng rng(8);
  LatticeScratch scratch;
  std::vector<StartPose> found;
  for (int i = 0; i < 24; ++i) {
    const Pose2 truth{rng.uniform(1.0, 5.0), rng.uniform(1.0, 3.0), rng.uniform(-3.0, 3.0)};
    const auto seen = test::points_of(Scan::make(test::sweep(walls, truth, 0.01, rng)).value());
    std::vector<Eigen::Vector2d> points;
    for (std::size_t k = 0; k < seen.size(); k += 23) points.push_back(seen[k]);
    // Windows of one block and of several tiles, oblong ones, and ones that reach out of the map.
    const bool is_wide = i % 2 == 1;
    const PoseLattice lattice{.middle = truth * Pose2{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), 0.3},
                              .moves_x = is_wide ? 140 : 9,
                              .moves_y = i % 3 == 0 ? 6 : 40,
                              .turns = is_wide ? 1 : 5,
                              .step_rad = 0.06,
                              .far_penalty = i % 4 == 0 ? 0.0 : 0.05};
    const LatticeWish wish{.keep = 1 + i % 7,
                           .hopeless = i % 5 == 0 ? 1.0 : 0.15,
                           .apart_m = i % 6 == 0 ? 0.0 : 0.2,
                           .apart_rad = 0.1};
    search_lattice(points, map, lattice, wish, scratch, found);
    const auto expected = best_of(try_all(points, map, lattice), points.size(), wish);
    ASSERT_EQ(found.size(), expected.size()) << i;
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].map_from_laser, expected[k].map_from_laser) << i << ", the " << k << "th";
      ASSERT_EQ(found[k].cost, expected[k].cost);
    }
  }
}

TEST(LatticeSearch, FarFromTheMapEveryPoseIsAsBadAndTheFirstIsGiven) {
  const NearnessPyramid map{SurfaceMap(WallIndex(test::niche_room()))};
  const std::vector<Eigen::Vector2d> points{{1.0, 0.0}, {0.0, 1.0}};
  LatticeScratch scratch;
  std::vector<StartPose> found;
  for (const double away : {100.0, 1e7, 1e300}) {
    search_lattice(points, map, {.middle = {away, -away, 0.0}, .moves_x = 3, .moves_y = 3, .turns = 1}, {},
                   scratch, found);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].cost, 1.0);
  }
}

TEST(LatticeSearch, TheWholeMapIsSearchedLikeAnyWindow) {
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const NearnessPyramid map{SurfaceMap(WallIndex(plan))};
  Rng rng(4);
  LatticeScratch scratch;
  std::vector<StartPose> found;
  const Eigen::Vector2d middle =
      map.low() + 0.5 * map.cell_m() * Eigen::Vector2d(map.width_cells(), map.height_cells());
  for (int i = 0; i < 5; ++i) {
    const Pose2 truth{rng.uniform(1.0, 5.0), rng.uniform(1.0, 3.0), rng.uniform(-3.0, 3.0)};
    const auto seen = test::points_of(Scan::make(test::sweep(walls, truth, 0.01, rng)).value());
    std::vector<Eigen::Vector2d> points;
    for (std::size_t k = 0; k < seen.size(); k += 11) points.push_back(seen[k]);
    search_lattice(points, map,
                   {.middle = {middle.x(), middle.y(), 0.0},
                    .moves_x = map.width_cells() / 2,
                    .moves_y = map.height_cells() / 2,
                    .turns = 72,
                    .step_rad = radians(2.5)},
                   {}, scratch, found);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT(distance_m(found[0].map_from_laser, truth), 0.15);
    EXPECT_LT(heading_difference_rad(found[0].map_from_laser, truth), radians(3.0));
  }
}

}  // namespace
}  // namespace beaconless
