// SPDX-License-Identifier: Apache-2.0
// What a map of cells costs: a room is drawn with its walls anywhere in their cells and turned against them.
#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kCell_m = 0.05;
constexpr int kPhases = 8;

/// How far estimates from scans without noise are off at places around the middle of the room, at most.
double worst_bias_m(const Map& map) {
  const FloorPlan room = test::rectangle(4, 4);
  const RayCaster walls(room.segments());
  const auto localizer = make_localizer({.method = "walls"}, map).value();
  Rng rng(111);
  double worst_m = 0.0;
  for (std::int64_t i = 0; i < 6; ++i) {
    const Pose2 truth{rng.uniform(1.5, 2.5), rng.uniform(1.5, 2.5), rng.uniform(-kPi, kPi)};
    localizer->start_at(truth);
    const PoseEstimate estimate =
        localizer->update(Scan::make(test::sweep(walls, truth, 0.0, rng, {25'000'000 * i})).value());
    EXPECT_TRUE(estimate.ok()) << estimate.reason;
    worst_m = std::max(worst_m, distance_m(estimate.map_from_base, truth));
  }
  return worst_m;
}

class WallsOnGrids : public testing::TestWithParam<int> {};  // the rows' heading in degrees

TEST_P(WallsOnGrids, AreOffByPartsOfACell) {
  double worst_m = 0.0;
  for (int phase = 0; phase < kPhases; ++phase) {
    RasterConfig config{.resolution_m = kCell_m, .heading_rad = radians(GetParam())};
    config.phase_x_cells = (phase + 0.25) / kPhases;
    config.phase_y_cells = (phase + 0.25) / kPhases;
    worst_m = std::max(worst_m, worst_bias_m(rasterize(test::rectangle(4, 4), config).value()));
  }
  RecordProperty("worst_mm", std::to_string(1e3 * worst_m));
  // Along the rows all cells of a wall are off by the same, half a cell to each side; along their diagonals
  // too, by the width of a cell there. In between the offsets average out.
  const bool is_aligned = GetParam() % 45 == 0;
  EXPECT_LT(worst_m, is_aligned ? 0.5 * std::sqrt(2.0) * kCell_m + 1e-3 : 0.002);
}

INSTANTIATE_TEST_SUITE_P(Headings, WallsOnGrids, testing::Values(0, 3, 7, 15, 22, 30, 38, 45),
                         [](const auto& heading) { return "degrees_" + std::to_string(heading.param); });

TEST(WallsOnPlans, AreNotOff) { EXPECT_LT(worst_bias_m(test::rectangle(4, 4)), 5e-5); }

}  // namespace
}  // namespace beaconless
