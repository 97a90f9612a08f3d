// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_view.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/report/grid_raster.hpp"
#include "beaconless/report/map_bounds.hpp"

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

const double kNan = std::nan("");

FloorPlan room() { return {{{{0, 0}, {8, 0}, {8, 5}, {0, 5}, {0, 0}}}}; }

OccupancyGrid grid_of(int width, int height) {
  OccupancyGrid grid;
  grid.width_cells = width;
  grid.height_cells = height;
  grid.occupancy_percent.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                OccupancyGrid::kFree);
  return grid;
}

PoseEstimate estimate_at(double x_m, double y_m, Status status = Status::ok) {
  PoseEstimate estimate;
  estimate.map_from_base = {x_m, y_m, 0.3};
  estimate.status = status;
  estimate.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  return estimate;
}

void expect_sound(const Picture& picture) {
  const std::string file = svg_file(picture);
  EXPECT_EQ(xml_fault(file), "");
  EXPECT_THAT(picture.svg.body(), Not(HasSubstr("\"nan")));
  EXPECT_THAT(picture.svg.body(), Not(HasSubstr("inf\"")));
}

TEST(MapView, HoldsWithoutAnything) {
  expect_sound(draw_map(FloorPlan{}, {}));
  expect_sound(draw_map(OccupancyGrid{}, {}));
  OccupancyGrid liar = grid_of(10, 10);
  liar.occupancy_percent.resize(5);
  expect_sound(draw_map(liar, {}));
  liar.width_cells = liar.height_cells = std::numeric_limits<int>::max();
  expect_sound(draw_map(liar, {}));
  expect_sound(draw_map(FloorPlan{{{}, {{1, 1}}, {{kNan, 0}, {1e300, 1}}}}, {}));
}

TEST(MapView, HoldsForOnePoseAndForPosesThatAreNone) {
  std::vector<PoseEstimate> estimates{estimate_at(1, 2)};
  expect_sound(draw_map(FloorPlan{}, estimates));
  estimates = {estimate_at(kNan, 2), estimate_at(1e300, 0), estimate_at(2, 2), PoseEstimate{}};
  estimates[2].covariance.setConstant(kNan);
  expect_sound(draw_map(room(), estimates));
}

TEST(MapView, IsTheSameEachTime) {
  const std::vector<PoseEstimate> estimates{estimate_at(1, 2), estimate_at(3, 3, Status::lost)};
  EXPECT_EQ(svg_file(draw_map(room(), estimates)), svg_file(draw_map(room(), estimates)));
}

TEST(MapView, NamesTheStatusesThatOccur) {
  const std::vector<PoseEstimate> estimates{estimate_at(1, 1), estimate_at(2, 1),
                                            estimate_at(2, 1, Status::degraded), estimate_at(3, 1)};
  const std::string file = svg_file(draw_map(room(), estimates));
  EXPECT_THAT(file, HasSubstr("estimate, ok"));
  EXPECT_THAT(file, HasSubstr("estimate, degraded"));  // one scan of a robot that stood still is seen too
  EXPECT_THAT(file, Not(HasSubstr("estimate, lost")));
}

TEST(MapView, ShowsHowTheRunEndedEvenOfARobotThatStoodStill) {
  const std::vector<PoseEstimate> estimates{estimate_at(2, 1), estimate_at(2, 1),
                                            estimate_at(2, 1, Status::lost),
                                            estimate_at(2, 1, Status::not_a_scan)};
  EXPECT_THAT(svg_file(draw_map(room(), estimates)), HasSubstr("estimate, lost"));
}

TEST(MapView, CountsPosesOutsideAndKeepsTheBuildingLarge) {
  const std::vector<PoseEstimate> estimates{estimate_at(1, 1), estimate_at(5000, 1, Status::lost)};
  EXPECT_THAT(draw_map(room(), estimates).note, HasSubstr("1 of 2 poses lie outside"));
  const auto bounds = bounds_of_run(Map{room()}, estimates, {});
  EXPECT_LT(bounds.sizes().maxCoeff(), 10.0);
  EXPECT_TRUE(bounds.contains(Eigen::Vector2d(8, 5)));
}

TEST(MapView, StaysSmallForManyPosesAndBeams) {
  Rng rng(3);
  std::vector<PoseEstimate> estimates;
  for (int i = 0; i < 100'000; ++i) {
    const Status status = i % 3 == 0 ? Status::degraded : Status::ok;
    estimates.push_back(estimate_at(rng.uniform(0, 8), rng.uniform(0, 5), status));
  }
  RawScan raw;
  raw.angle_min_rad = -3.14F;
  raw.angle_increment_rad = 6.28F / 200'000.0F;
  raw.range_max_m = 30.0F;
  for (int i = 0; i < 200'000; ++i) raw.ranges_m.push_back(static_cast<float>(rng.uniform(0.5, 4.0)));
  const std::vector<PlacedScan> scans{{Scan::make(raw).value(), {4, 2.5, 0}}};
  EXPECT_LT(svg_file(draw_map(room(), estimates, {}, scans)).size(), 4'000'000U);
}

TEST(MapBounds, HoldTheOccupiedCellsOfATurnedGrid) {
  Rng rng(8);
  OccupancyGrid grid = grid_of(40, 30);
  grid.map_from_grid = {-3.0, 2.0, 0.6};
  for (auto& cell : grid.occupancy_percent)
    cell = rng.uniform() < 0.01 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  Eigen::AlignedBox2d box;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      if (grid.is_occupied({x, y})) box.extend(grid.center({x, y}));
  const auto bounds = bounds_of_run(Map{grid}, {}, {});
  EXPECT_TRUE(bounds.contains(box));
  EXPECT_LT((bounds.sizes() - box.sizes()).maxCoeff(), 0.3);  // the margin: twice 0.1 m or 4 % of 2 m
}

TEST(GridRaster, PutsEachCellWhereTheMapHasIt) {
  OccupancyGrid grid = grid_of(6, 4);
  grid.map_from_grid = {10.0, -3.0, 0.7};
  grid.resolution_m = 0.2;
  grid.occupancy_percent[grid.index({4, 1})] = 100;
  grid.occupancy_percent[grid.index({0, 3})] = OccupancyGrid::kUnknown;
  const GridRaster raster = raster_of(grid);
  ASSERT_EQ(raster.image.width_px, 6);
  ASSERT_EQ(raster.image.height_px, 4);
  EXPECT_EQ(raster.image.pixels[(3 - 1) * 6 + 4], 15);  // darkest, in the second row from below
  EXPECT_EQ(raster.image.pixels[0], 0);                 // unknown, in the upper left corner
  const Eigen::Vector2d middle =
      raster.map_from_image * Eigen::Vector2d(4.5 * raster.pixel_m, 1.5 * raster.pixel_m);
  EXPECT_LT((middle - grid.center({4, 1})).norm(), 1e-12);
}

TEST(GridRaster, KeepsThinWallsWhenCellsAreMerged) {
  OccupancyGrid grid = grid_of(1000, 700);
  for (int x = 0; x < 1000; ++x) grid.occupancy_percent[grid.index({x, 321})] = 100;
  const GridRaster raster = raster_of(grid, 10'000);
  EXPECT_LE(raster.image.pixels.size(), 10'000U);
  const auto dark = std::count(raster.image.pixels.begin(), raster.image.pixels.end(), 15);
  EXPECT_EQ(dark, raster.image.width_px);
}

TEST(GridRaster, LeavesOutWhatNobodyKnows) {
  OccupancyGrid grid = grid_of(100, 100);
  std::fill(grid.occupancy_percent.begin(), grid.occupancy_percent.end(), OccupancyGrid::kUnknown);
  EXPECT_TRUE(raster_of(grid).image.pixels.empty());
  grid.occupancy_percent[grid.index({40, 60})] = 100;
  const GridRaster raster = raster_of(grid);
  EXPECT_EQ(raster.image.pixels.size(), 1U);
  EXPECT_DOUBLE_EQ(raster.map_from_image.x_m, 40 * grid.resolution_m);
}

}  // namespace
}  // namespace beaconless::report
