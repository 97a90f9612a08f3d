// SPDX-License-Identifier: Apache-2.0
// Regions to look for a robot in, and the map.
#include "apps/beaconless/region_on_map.hpp"

#include <vector>

#include <gmock/gmock.h>

#include "beaconless/map/rasterize.hpp"

namespace beaconless::cli {
namespace {

/// A room of 3 x 4 m, once drawn and once as a grid with nothing around it for ten metres.
std::vector<Map> maps() {
  const FloorPlan room{{{{5, 5}, {8, 5}, {8, 9}, {5, 9}, {5, 5}}}};
  return {room, rasterize(room, {.resolution_m = 0.05, .margin_m = 10.0}).value()};
}

TEST(RegionOnMap, IsWhereItReachesTheWallsOrWhatIsBetweenThem) {
  for (const Map& map : maps()) {
    EXPECT_TRUE(check_on_map("", {{6.5, 7.0}, 0.1}, map)) << "in the middle";
    EXPECT_TRUE(check_on_map("", {{0.0, 7.0}, 5.1}, map));
    EXPECT_FALSE(check_on_map("", {{0.0, 7.0}, 4.9}, map));
    EXPECT_TRUE(check_on_map("", {{4.0, 4.0}, 1.5}, map));
    EXPECT_FALSE(check_on_map("", {{4.0, 4.0}, 1.35}, map)) << "only the square around it reaches the room";
    EXPECT_TRUE(check_on_map("", {{-1000.0, 0.0}, 2000.0}, map));
  }
}

TEST(RegionOnMap, WhereItIsNotTheErrorTellsWhereTheMapIs) {
  const auto checked = check_on_map("near:1,2,1", {{1.0, 2.0}, 1.0}, maps().front());
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().where, "--start");
  EXPECT_THAT(checked.error().what, testing::HasSubstr("\"near:1,2,1\""));
  EXPECT_THAT(checked.error().what, testing::HasSubstr("between 5.0,5.0 and 8.0,9.0"));
  EXPECT_THAT(checked.error().remedy, testing::HasSubstr("near:x,y,radius"));
}

TEST(RegionOnMap, OfAMapWithoutWallsIsNotJudged) {
  OccupancyGrid grid;
  grid.width_cells = grid.height_cells = 2;
  grid.occupancy_percent.assign(4, OccupancyGrid::kFree);
  EXPECT_TRUE(check_on_map("", {{100.0, 100.0}, 1.0}, Map(grid)));
}

}  // namespace
}  // namespace beaconless::cli
