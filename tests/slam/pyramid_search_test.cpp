// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/pyramid_search.hpp"

#include <gtest/gtest.h>

#include "beaconless/slam/growing_map.hpp"
#include "beaconless/slam/overlap.hpp"

#include "tests/slam/drives.hpp"

namespace beaconless {
namespace {

using test::rounds;
using test::TrueScan;

/// A map of a round through the niche room, and a scan from within.
class SearchedRoom : public testing::Test {
 protected:
  void SetUp() override {
    for (const TrueScan& at : rounds(test::niche_room(), 0.01, 40)) {
      std::vector<BeamWay> ways;
      beam_ways(at.scan, at.map_from_laser, {}, ways);
      ASSERT_TRUE(map.add(at.map_from_laser.translation(), ways));
    }
    const RayCaster walls(test::niche_room().segments());
    Rng rng(2);
    points = test::points_of(test::scan_at(walls, truth, 0.01, rng, {}));
  }
  const OccupancyLevel& coarse() const { return map.pyramid().levels.back(); }

  Pose2 truth{3.3, 1.9, 0.7};
  GrowingMap map{GrowingMapConfig{}};
  std::vector<Eigen::Vector2d> points;
  PyramidSearchScratch scratch;
  std::vector<FoundPose> found;
};

TEST_F(SearchedRoom, TheBestPoseIsACellFromTheTruth) {
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const Pose2 guess{truth.x_m + rng.uniform(-0.55, 0.55), truth.y_m + rng.uniform(-0.55, 0.55),
                      truth.theta_rad + radians(rng.uniform(-28.0, 28.0))};
    search_pyramid(points, coarse(), guess, {}, scratch, found);
    ASSERT_FALSE(found.empty());
    EXPECT_LT(distance_m(found.front().map_from_laser, truth), 0.21);
    EXPECT_LT(degrees(heading_difference_rad(found.front().map_from_laser, truth)), 3.0);
  }
}

TEST_F(SearchedRoom, BestFirstAndApart) {
  const PyramidSearchConfig config{.keep = 6};
  search_pyramid(points, coarse(), truth, config, scratch, found);
  ASSERT_GE(found.size(), 2U);
  EXPECT_LE(found.size(), 6U);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].score, found[i - 1].score);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool apart =
          distance_m(found[i].map_from_laser, found[j].map_from_laser) >= 0.3 ||
          degrees(heading_difference_rad(found[i].map_from_laser, found[j].map_from_laser)) >= 3.0;
      EXPECT_TRUE(apart);
    }
  }
}

// Slow twin: every pose of the window, every point asked for its cell by the level itself.
TEST_F(SearchedRoom, ScoresAreWhatTheCellsSay) {
  const PyramidSearchConfig config{
      .window_m = 0.4, .window_deg = 6.0, .points = 100000, .far_penalty = 0.0, .keep = 1};
  const Pose2 guess{3.1, 2.0, 0.65};
  search_pyramid(points, coarse(), guess, config, scratch, found);
  const double step_m = coarse().resolution_m();
  double best = -2.0;
  for (int k = -4; k <= 4; ++k) {
    for (int dx = -2; dx <= 2; ++dx) {
      for (int dy = -2; dy <= 2; ++dy) {
        const Pose2 pose{guess.x_m + dx * step_m, guess.y_m + dy * step_m,
                         guess.theta_rad + radians(1.5 * k)};
        double sum = 0.0;
        for (const Eigen::Vector2d& point : points) {
          const Eigen::Vector2d at = (pose * point) / step_m;
          const Cell cell{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
          if (!coarse().is_known(cell)) continue;
          sum += coarse().value(cell) > 0.0 ? coarse().value(cell) : -0.5;
        }
        best = std::max(best, sum / static_cast<double>(points.size()));
      }
    }
  }
  ASSERT_EQ(found.size(), 1U);
  // A point within rounding of a border may count for either cell.
  EXPECT_NEAR(found.front().score, best, 4.0 / static_cast<double>(points.size()));
}

TEST_F(SearchedRoom, AsManyPointsFitTheMapAsItsOverlapSays) {
  const Overlap here = overlap_of(points, map.pyramid().levels.front(), truth);
  EXPECT_GT(here.on_ratio, 0.95);
  EXPECT_LT(here.off_ratio, 0.03);
  const Overlap turned = overlap_of(points, map.pyramid().levels.front(), {3.3, 1.9, 1.6});
  EXPECT_LT(turned.score(), here.score() - 0.5);
  EXPECT_NEAR(turned.on_ratio + turned.off_ratio + turned.new_ratio(), 1.0, 1e-12);
  const Overlap away = overlap_of(points, map.pyramid().levels.front(), {500.0, 0.0, 0.0});
  EXPECT_EQ(away.new_ratio(), 1.0);
  EXPECT_EQ(away.explained_ratio(), 1.0);
}

// Slow twin: a point is on an obstacle where one of the four cells around it is one.
TEST_F(SearchedRoom, OverlapIsWhatTheFourCellsSay) {
  const OccupancyLevel& level = map.pyramid().levels.front();
  Rng rng(6);
  for (int i = 0; i < 20; ++i) {
    const Pose2 pose{rng.uniform(-1.0, 8.0), rng.uniform(-1.0, 6.0), rng.uniform(-3.0, 3.0)};
    int on = 0;
    int off = 0;
    for (const Eigen::Vector2d& point : points) {
      const Eigen::Vector2d at = (pose * point) / level.resolution_m() - Eigen::Vector2d(0.5, 0.5);
      const Cell cell{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
      bool is_on = false;
      bool is_known = true;
      for (const Cell& near :
           {cell, Cell{cell.x + 1, cell.y}, Cell{cell.x, cell.y + 1}, Cell{cell.x + 1, cell.y + 1}}) {
        is_on = is_on || level.value(near) > 0.298;
        is_known = is_known && level.is_known(near);
      }
      on += is_on ? 1 : 0;
      off += !is_on && is_known ? 1 : 0;
    }
    const Overlap overlap = overlap_of(points, level, pose);
    const double all = static_cast<double>(points.size());
    EXPECT_NEAR(overlap.on_ratio, on / all, 2.0 / all);
    EXPECT_NEAR(overlap.off_ratio, off / all, 2.0 / all);
  }
}

TEST_F(SearchedRoom, OddInput) {
  search_pyramid({}, coarse(), truth, {}, scratch, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(overlap_of({}, coarse(), truth).on_ratio, 0.0);
  search_pyramid(points, coarse(), {1e5, 1e5, 0.0}, {}, scratch, found);
  for (const FoundPose& pose : found) EXPECT_LE(pose.score, 0.0);
  const OccupancyLevel empty(0.1, {});
  search_pyramid(points, empty, truth, {}, scratch, found);
  for (const FoundPose& pose : found) EXPECT_LE(pose.score, 0.0);
  search_pyramid(points, coarse(), truth, {.window_m = 0.0, .window_deg = 0.0}, scratch, found);
  EXPECT_EQ(found.size(), 1U);
}

}  // namespace
}  // namespace beaconless
