// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/global_search.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/match/best_apart.hpp"
#include "beaconless/match/tile_sums.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points seen_in(const FloorPlan& plan, const Pose2& pose, Rng& rng) {
  return test::points_of(Scan::make(test::sweep(RayCaster(plan.segments()), pose, 0.01, rng)).value());
}

Pose2 somewhere(Rng& rng) { return {rng.uniform(0.7, 5.3), rng.uniform(0.7, 3.0), rng.uniform(-3.1, 3.1)}; }

SurfaceMap map_of(const FloorPlan& plan) { return WallIndex(plan); }

std::vector<StartPose> search(const Points& points, const NearnessPyramid& map, const FloorPlan::Bounds& box,
                              const GlobalSearchConfig& config) {
  GlobalSearchScratch scratch;
  std::vector<StartPose> places;
  search_everywhere(points, map, box, config, scratch, places);
  return places;
}

bool is_same(const std::vector<StartPose>& a, const std::vector<StartPose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const StartPose& p, const StartPose& q) {
    return p.map_from_laser == q.map_from_laser && p.cost == q.cost;
  });
}

/// Every pose of the box at every heading, and of all of them the best apart.
std::vector<StartPose> try_all(const Points& all_points, const NearnessPyramid& map,
                               const FloorPlan::Bounds& box, const GlobalSearchConfig& config) {
  Points points;
  thin(all_points, config.points, points);
  const Eigen::Vector2d middle = 0.5 * (box.low + box.high);
  const double cell_m = map.cell_m();
  const auto moves = [&](double size_m) { return static_cast<int>(std::ceil(0.5 * size_m / cell_m)); };
  const int moves_x = moves((box.high - box.low).x());
  const int moves_y = moves((box.high - box.low).y());
  const int turns = static_cast<int>(std::ceil(180.0 / config.step_deg));
  const double worst = 255.0 * static_cast<double>(points.size());
  struct Tried {
    Pose2 pose;
    int cost;
  };
  std::vector<Tried> tried;
  int least = 1 << 30;
  for (int k = -turns; k <= turns; ++k) {
    const double theta = wrap_angle(k * radians(config.step_deg));
    std::vector<Cell> cells;
    for (const Eigen::Vector2d& point : points)
      cells.push_back(
          cell_of(Eigen::Vector2d((middle - map.low()) / cell_m - Eigen::Vector2d(moves_x, moves_y) +
                                  Pose2{0.0, 0.0, theta}.rotation() / cell_m * point)));
    for (int y = 0; y <= 2 * moves_y; ++y)
      for (int x = 0; x <= 2 * moves_x; ++x) {
        int cost = static_cast<int>(worst);
        for (const Cell& cell : cells) {
          const std::uint8_t* at = map.tile(0, {cell.x + x, cell.y + y});
          cost -= at == nullptr ? 0 : *at;
        }
        least = std::min(least, cost);
        if (cost <= least + static_cast<int>(config.hopeless * worst))
          tried.push_back(
              {{middle.x() + (x - moves_x) * cell_m, middle.y() + (y - moves_y) * cell_m, theta}, cost});
      }
  }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried& a, const Tried& b) { return a.cost < b.cost; });
  std::vector<StartPose> best;
  for (const Tried& pose : tried) {
    if (pose.cost > least + static_cast<int>(config.hopeless * worst)) break;
    if (best.size() == static_cast<std::size_t>(config.keep)) break;
    const bool is_near = std::any_of(best.begin(), best.end(), [&](const StartPose& better) {
      return (pose.pose.translation() - better.map_from_laser.translation()).squaredNorm() < 0.25 &&
             heading_difference_rad(pose.pose, better.map_from_laser) < radians(10.0);
    });
    if (!is_near) best.push_back({pose.pose, pose.cost / worst});
  }
  return best;
}

TEST(GlobalSearch, FindsWhatTryingEveryPoseFindsWithAnyNumberOfThreads) {
  const FloorPlan plan = test::niche_room();
  const SurfaceMap walls = map_of(plan);
  const FloorPlan::Bounds box = bounds_of(walls);
  Rng rng(6);
  // Few headings are searched block by block, many by parts of all blocks at once.
  for (const double step_deg : {2.0, 0.25})
    for (const double hopeless : {0.02, 0.15}) {
      GlobalSearchConfig config{.step_deg = step_deg, .points = 30, .keep = 12, .hopeless = hopeless};
      const NearnessPyramid map(walls, config.cell_m, config.truncate_m);
      Points points = seen_in(plan, somewhere(rng), rng);
      for (std::size_t i = 0; i < points.size(); i += 3) points[i] *= rng.uniform(0.3, 1.0);
      const auto expected = try_all(points, map, box, config);
      ASSERT_FALSE(expected.empty());
      for (const int threads : {1, 2, 5}) {
        config.threads = threads;
        EXPECT_TRUE(is_same(search(points, map, box, config), expected)) << step_deg << " " << threads;
      }
    }
}

TEST(GlobalSearch, TheTruePlaceIsTheBest) {
  const FloorPlan plan = test::niche_room();
  const SurfaceMap walls = map_of(plan);
  const NearnessPyramid map(walls, 0.1, 0.4);
  Rng rng(7);
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth = somewhere(rng);
    const auto places = search(seen_in(plan, truth, rng), map, bounds_of(walls), {});
    ASSERT_FALSE(places.empty());
    EXPECT_LT(distance_m(places[0].map_from_laser, truth), 0.1);
    EXPECT_LT(heading_difference_rad(places[0].map_from_laser, truth), radians(2.0));
  }
}

/// A plan moved by a shift, or turned by 90 degrees about the origin first.
FloorPlan moved(FloorPlan plan, const Eigen::Vector2d& by, bool is_turned) {
  for (auto& wall : plan.walls)
    for (Eigen::Vector2d& corner : wall)
      corner = (is_turned ? Eigen::Vector2d(-corner.y(), corner.x()) : corner) + by;
  return plan;
}

TEST(GlobalSearch, AMapThatIsMovedByWholeCellsMovesWhatIsFound) {
  const FloorPlan plan = test::niche_room();
  const SurfaceMap walls = map_of(plan);
  const GlobalSearchConfig config{.cell_m = 0.125, .step_deg = 2.0, .truncate_m = 0.5};
  const NearnessPyramid map(walls, config.cell_m, config.truncate_m);
  const Eigen::Vector2d by(16.0, -3.125);
  Rng rng(8);
  for (int i = 0; i < 5; ++i) {
    const Points points = seen_in(plan, somewhere(rng), rng);
    const auto here = search(points, map, bounds_of(walls), config);
    for (const bool is_turned : {false, true}) {
      const SurfaceMap other = map_of(moved(plan, by, is_turned));
      const NearnessPyramid there_map(other, config.cell_m, config.truncate_m);
      const auto there = search(points, there_map, bounds_of(other), config);
      ASSERT_FALSE(there.empty());
      const Pose2 turn{by.x(), by.y(), is_turned ? radians(90.0) : 0.0};
      const Pose2 expected = turn * here.front().map_from_laser;
      EXPECT_EQ(there.front().cost, here.front().cost) << is_turned;
      EXPECT_LT(distance_m(there.front().map_from_laser, expected), 1e-9) << is_turned;
      EXPECT_LT(heading_difference_rad(there.front().map_from_laser, expected), 1e-9) << is_turned;
      if (!is_turned) {
        EXPECT_EQ(there.size(), here.size());
      }
    }
  }
}

TEST(GlobalSearch, OfAPartOfTheMapOnlyThatIsSearched) {
  const FloorPlan plan = test::niche_room();
  const SurfaceMap walls = map_of(plan);
  const GlobalSearchConfig config{.hopeless = 1.0};
  const NearnessPyramid map(walls, config.cell_m, config.truncate_m);
  Rng rng(9);
  const Pose2 truth{4.5, 1.5, 1.0};
  const Points points = seen_in(plan, truth, rng);
  for (const FloorPlan::Bounds& box : {FloorPlan::Bounds{{0.5, 0.5}, {2.5, 3.0}}, {{4.0, 1.0}, {5.0, 2.0}}}) {
    const auto places = search(points, map, box, config);
    ASSERT_FALSE(places.empty());
    for (const StartPose& place : places) {
      const Eigen::Vector2d at = place.map_from_laser.translation();
      EXPECT_TRUE((at.array() > box.low.array() - 0.11).all() && (at.array() < box.high.array() + 0.11).all())
          << place.map_from_laser;
    }
    const bool is_inside = box.low.x() == 4.0;
    EXPECT_EQ(distance_m(places.front().map_from_laser, truth) < 0.15, is_inside);
  }
}

TEST(GlobalSearch, OfNothingFindsNothing) {
  const SurfaceMap walls = map_of(test::niche_room());
  const NearnessPyramid map(walls, 0.1, 0.4);
  EXPECT_TRUE(search({}, map, bounds_of(walls), {}).empty());
  const FloorPlan::Bounds inside_out{{3.0, 3.0}, {1.0, 1.0}};
  for (const StartPose& place : search({{1.0, 0.0}}, map, inside_out, {}))
    EXPECT_LT((place.map_from_laser.translation() - Eigen::Vector2d(2.0, 2.0)).norm(), 1e-9);
}

TEST(TileSums, NoPartOfABlockIsNearerThanTheBlock) {
  const NearnessPyramid map(map_of(test::niche_room()), 0.1, 0.4);
  Rng rng(10);
  for (int i = 0; i < 200; ++i) {
    std::vector<Cell> cells(static_cast<std::size_t>(rng.uniform(1.0, 60.0)));
    for (Cell& cell : cells)
      cell = {static_cast<int>(rng.uniform(-30.0, 110.0)), static_cast<int>(rng.uniform(-30.0, 90.0))};
    for (int level = 1; level < NearnessPyramid::kLevels; ++level) {
      const TileSums blocks = sum_tiles(map, level, cells, 0, 0);
      const int step = NearnessPyramid::block_cells(level);
      for (int row = 0; row < NearnessPyramid::kTileRows; ++row)
        for (int column = 0; column < NearnessPyramid::kTileColumns; ++column) {
          const TileSums parts = sum_tiles(map, level - 1, cells, column * step, row * step);
          for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) ASSERT_LE(parts.at(x, y), blocks.at(column, row));
        }
    }
  }
}

TEST(TileSums, AreGivenWhereAnyReachesTheLeastAndElseMayBeNone) {
  const NearnessPyramid map(map_of(test::niche_room()), 0.1, 0.4);
  Rng rng(12);
  int none = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<Cell> cells(120);
    for (Cell& cell : cells)
      cell = {static_cast<int>(rng.uniform(-5.0, 90.0)), static_cast<int>(rng.uniform(-5.0, 65.0))};
    const TileSums sums = sum_tiles(map, 1, cells, 0, 0);
    int most = 0;
    for (const auto* half : {&sums.even, &sums.odd})
      for (const auto& row : *half)
        for (const int sum : row) most = std::max(most, sum);
    for (const int least : {most - 1, most, most + 1, most + 5000}) {
      const TileSums wanted = sum_tiles(map, 1, cells, 0, 0, least);
      const bool is_none = wanted.even == TileSums{}.even && wanted.odd == TileSums{}.odd;
      const bool is_all = wanted.even == sums.even && wanted.odd == sums.odd;
      ASSERT_TRUE(is_all || (least > most && is_none));
      none += is_none ? 1 : 0;
    }
  }
  EXPECT_GT(none, 100);  // or nothing is saved
}

}  // namespace
}  // namespace beaconless
