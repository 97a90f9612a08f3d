// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector_sums.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/occupancy_pyramid.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

std::vector<VectorLoop> loops() {
  std::vector<VectorLoop> all{VectorLoop::portable};
  if (fastest_vector_loop() != VectorLoop::portable) all.push_back(fastest_vector_loop());
  return all;
}

struct TwinSums {
  HectorSums sums;
  HectorFit fit;
};

/// The same sums, point by point from what the level says of itself, in doubles.
TwinSums twin(const Points& points, const OccupancyLevel& level, const Pose2& grid_from_laser, double least) {
  const double length_m = level.resolution_m();
  const Eigen::Matrix2d grid_from_map = level.map_from_grid().rotation().transpose();
  TwinSums twin;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = grid_from_laser.rotation() * point;
    const auto sample = level.sample(level.map_from_grid() * (grid_from_laser.translation() + arm));
    const Eigen::Vector2d slope = length_m * (grid_from_map * sample.slope_per_m);
    const Eigen::Vector3d jacobian(slope.x(), slope.y(), slope.y() * arm.x() - slope.x() * arm.y());
    const double left_m = (1.0 - sample.value) * length_m;
    twin.sums.hessian += jacobian * jacobian.transpose();
    twin.sums.gradient += jacobian * left_m;
    twin.sums.near_count += sample.value > 1e-6 ? 1 : 0;
    const double share = std::min(1.0, (1.0 - sample.value) / (1.0 - least));
    twin.fit.near_count += sample.value > least ? 1 : 0;
    twin.fit.misfit_sum += share * share;
    twin.fit.pull_m2 += slope.squaredNorm() * left_m * left_m;
    twin.fit.slope_sum += slope.squaredNorm();
  }
  return twin;
}

OccupancyLevel random_level(Rng& rng, double resolution_m, const Pose2& map_from_grid, Cell low) {
  OccupancyLevel level(resolution_m, map_from_grid);
  level.cover(low, {low.x + 60, low.y + 40}).value();
  for (int y = 0; y <= 40; ++y)
    for (int x = 0; x <= 60; ++x)
      if (rng.uniform() < 0.8) level.set({low.x + x, low.y + y}, rng.uniform() < 0.5 ? 0.0 : rng.uniform());
  return level;
}

TEST(HectorSums, AreThoseOfThePlainFormForAnyCellsPointsAndPoses) {
  Rng rng(1);
  for (const VectorLoop loop : loops())
    for (int run = 0; run < 40; ++run) {
      const Pose2 map_from_grid{rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0), rng.uniform(-3.0, 3.0)};
      const double resolution_m = rng.uniform(0.02, 0.3);
      const Cell low{static_cast<int>(rng.uniform(-50.0, 50.0)), static_cast<int>(rng.uniform(-50.0, 50.0))};
      const OccupancyLevel level = random_level(rng, resolution_m, map_from_grid, low);
      const Pose2 pose{resolution_m * (low.x + rng.uniform(-5.0, 65.0)),
                       resolution_m * (low.y + rng.uniform(-5.0, 45.0)), rng.uniform(-3.0, 3.0)};
      Points points(static_cast<std::size_t>(rng.uniform(0.0, 300.0)));
      for (auto& point : points)
        point = 30.0 * resolution_m * Eigen::Vector2d(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
      const double least = rng.uniform(0.0, 0.9);
      HectorPoints loaded;
      loaded.load(points);
      const HectorSums sums = sum_hector(loaded, level, pose, loop);
      const HectorFit fit = fit_hector(loaded, level, pose, least, loop);
      const TwinSums plain = twin(points, level, pose, least);

      // Floats have 24 bits: places are off by 1e-6 of 60 cells, and so are the slopes between the middles of
      // cells; across a middle they jump, which a point in ten thousand may do.
      const double tolerance = 1e-4 * (1.0 + static_cast<double>(points.size()));
      const Eigen::Vector3d unit(1.0, 1.0, 1.0 / (20.0 * resolution_m));
      const Eigen::Matrix3d hessian_off =
          unit.asDiagonal() * (sums.hessian - plain.sums.hessian) * unit.asDiagonal();
      ASSERT_LT(hessian_off.cwiseAbs().maxCoeff(), tolerance);
      ASSERT_LT(unit.cwiseProduct(sums.gradient - plain.sums.gradient).cwiseAbs().maxCoeff(),
                tolerance * resolution_m);
      ASSERT_NEAR(sums.near_count, plain.sums.near_count, 1);
      ASSERT_NEAR(fit.near_count, plain.fit.near_count, 1);
      ASSERT_NEAR(fit.misfit_sum, plain.fit.misfit_sum, tolerance);
      ASSERT_NEAR(fit.pull_m2, plain.fit.pull_m2, tolerance * resolution_m * resolution_m);
      ASSERT_NEAR(fit.slope_sum, plain.fit.slope_sum, tolerance);
    }
}

/// A scan of a room, at a pose that is off, on a level of the plan turned by an angle.
struct Scene {
  Rng rng{3};
  FloorPlan plan = test::niche_room();
  OccupancyLevel level = build_pyramid(plan).value().levels.front();
  Points points = test::points_of(
      Scan::make(test::sweep(RayCaster(plan.segments()), {3.0, 2.0, 0.4}, 0.01, rng)).value());
  Pose2 pose = level.map_from_grid().inverse() * Pose2{3.02, 1.99, 0.41};
};

TEST(HectorSums, PullDownhillOfTheSumOfSquaresBesideObliqueWalls) {
  // The half of its slope, by central differences of the plain form. With the blends of the differences
  // swapped (as hector_slam has them) a share of 1e-2 and more is missing here.
  const Scene s;
  HectorPoints loaded;
  loaded.load(s.points);
  const auto cost = [&](const Eigen::Vector3d& step) {
    const Pose2 there{s.pose.x_m + step.x(), s.pose.y_m + step.y(), s.pose.theta_rad + step.z()};
    return twin(s.points, s.level, there, 0.0).fit.misfit_sum * 0.05 * 0.05;
  };
  for (const VectorLoop loop : loops()) {
    const HectorSums sums = sum_hector(loaded, s.level, s.pose, loop);
    for (const int axis : {0, 1, 2}) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
      const double downhill = -0.5 * (cost(step) - cost(-step)) / 2e-6;
      EXPECT_NEAR(sums.gradient[axis], downhill, 2e-4 * sums.gradient.cwiseAbs().maxCoeff());
    }
  }
}

TEST(HectorSums, SwappedBlendsWouldBeNoticed) {
  // What the two tests above compare with is not what swapped blends give: here they are, on the same scene.
  const Scene s;
  Eigen::Vector3d swapped = Eigen::Vector3d::Zero();
  for (const Eigen::Vector2d& point : s.points) {
    const Eigen::Vector2d arm = s.pose.rotation() * point;
    const Eigen::Vector2d place = (s.pose.translation() + arm) / 0.05 - Eigen::Vector2d(0.5, 0.5);
    const Cell cell{static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y()))};
    const double fx = place.x() - cell.x;
    const double fy = place.y() - cell.y;
    const double m00 = s.level.value(cell);
    const double m10 = s.level.value({cell.x + 1, cell.y});
    const double m01 = s.level.value({cell.x, cell.y + 1});
    const double m11 = s.level.value({cell.x + 1, cell.y + 1});
    const double gx = (1.0 - fx) * (m10 - m00) + fx * (m11 - m01);
    const double gy = (1.0 - fy) * (m01 - m00) + fy * (m11 - m10);
    const double value = (1.0 - fy) * ((1.0 - fx) * m00 + fx * m10) + fy * ((1.0 - fx) * m01 + fx * m11);
    swapped += Eigen::Vector3d(gx, gy, gy * arm.x() - gx * arm.y()) * (1.0 - value) * 0.05;
  }
  const Eigen::Vector3d right = twin(s.points, s.level, s.pose, 0.0).sums.gradient;
  EXPECT_GT((swapped - right).cwiseAbs().maxCoeff(), 1e-2 * right.cwiseAbs().maxCoeff());
}

TEST(HectorSums, AreTheSameWhereverTheGridIsCountedFrom) {
  // Kilometres from the origin of its cells a grid is as exact as beside it.
  Rng rng(5);
  const auto sums_from = [](int x, int y, const VectorLoop loop) {
    Rng same(9);
    const OccupancyLevel level = random_level(same, 0.05, {}, {x, y});
    Points points(200);
    for (auto& point : points) point = {same.uniform(-1.5, 1.5), same.uniform(-1.0, 1.0)};
    HectorPoints loaded;
    loaded.load(points);
    return sum_hector(loaded, level, {0.05 * (x + 30.3), 0.05 * (y + 20.7), 0.3}, loop);
  };
  for (const VectorLoop loop : loops()) {
    const HectorSums here = sums_from(0, 0, loop);
    const HectorSums there = sums_from(-200'000, 300'000, loop);
    EXPECT_EQ(here.near_count, there.near_count);
    EXPECT_LT((here.hessian - there.hessian).norm(), 1e-4 * here.hessian.norm());
    EXPECT_LT((here.gradient - there.gradient).norm(), 1e-4 * here.gradient.norm());
  }
}

TEST(HectorSums, BothLoopsAgreeToRounding) {
  const Scene s;
  HectorPoints loaded;
  loaded.load(s.points);
  const HectorSums portable = sum_hector(loaded, s.level, s.pose, VectorLoop::portable);
  const HectorSums fastest = sum_hector(loaded, s.level, s.pose, fastest_vector_loop());
  EXPECT_EQ(portable.near_count, fastest.near_count);
  EXPECT_LT((portable.hessian - fastest.hessian).norm(), 1e-5 * portable.hessian.norm());
  EXPECT_LT((portable.gradient - fastest.gradient).norm(), 1e-5 * portable.gradient.norm());
}

TEST(HectorSums, PointsThatNoMapHoldsAddNothing) {
  const Scene s;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  HectorPoints clean;
  clean.load(s.points);
  Points mixed;
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    mixed.push_back(s.points[i]);
    mixed.push_back(i % 5 == 0   ? Eigen::Vector2d(nan, 1.0)
                    : i % 5 == 1 ? Eigen::Vector2d(1.0, -inf)
                    : i % 5 == 2 ? Eigen::Vector2d(1e300, 0.0)
                    : i % 5 == 3 ? Eigen::Vector2d(-9e3, 9e3)
                                 : Eigen::Vector2d(40.0, 3.0));
  }
  HectorPoints loaded;
  loaded.load(mixed);
  EXPECT_LT(loaded.count, mixed.size());
  for (const VectorLoop loop : loops()) {
    const HectorSums alone = sum_hector(clean, s.level, s.pose, loop);
    const HectorSums among = sum_hector(loaded, s.level, s.pose, loop);
    EXPECT_EQ(alone.near_count, among.near_count);
    EXPECT_LT((alone.hessian - among.hessian).norm(), 1e-5 * alone.hessian.norm());
    const HectorFit fit_alone = fit_hector(clean, s.level, s.pose, 0.0, loop);
    const HectorFit fit_among = fit_hector(loaded, s.level, s.pose, 0.0, loop);
    EXPECT_NEAR(fit_among.misfit_sum - fit_alone.misfit_sum, static_cast<double>(loaded.count - clean.count),
                1e-3);
  }
}

TEST(HectorSums, OfNoPointsOrFarAwayAreNone) {
  const Scene s;
  HectorPoints none;
  none.load({});
  EXPECT_EQ(none.count, 0U);
  HectorPoints loaded;
  loaded.load(s.points);
  for (const VectorLoop loop : loops()) {
    EXPECT_EQ(sum_hector(none, s.level, s.pose, loop).hessian.norm(), 0.0);
    for (const double far_m : {1e3, 1e6, 1e12}) {
      const HectorSums far = sum_hector(loaded, s.level, {far_m, -far_m, 1.0}, loop);
      EXPECT_EQ(far.near_count, 0);
      EXPECT_EQ(far.hessian.norm(), 0.0);
      EXPECT_EQ(fit_hector(loaded, s.level, {far_m, -far_m, 1.0}, 0.0, loop).misfit_sum,
                static_cast<double>(loaded.count));
    }
    EXPECT_EQ(sum_hector(loaded, OccupancyLevel(0.05, {}), s.pose, loop).near_count, 0);
  }
}

}  // namespace
}  // namespace beaconless
