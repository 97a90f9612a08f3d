// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/grid_io.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"

#include "tests/io/picture_bytes.hpp"
#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kHead = "image: a.pgm\nresolution: 0.1\norigin: [1.0, -2.0, 0.0]\n";

/// A 3 x 2 picture: black, gray 205, white above; white, gray 128, black below.
std::string six_pixels() { return p5(3, 2, "\x00\xCD\xFE\xFF\x80\x00"s); }

OccupancyGrid grid_of(const TempFolder& folder, const std::string& yaml) {
  folder.write("a.pgm", six_pixels());
  return read_grid(folder.write("a.yaml", yaml)).value();
}

TEST(GridIo, ReadsRowsFromTheTopIntoCellsFromTheBottom) {
  const TempFolder folder;
  const OccupancyGrid grid = grid_of(folder, kHead);
  EXPECT_EQ(grid.width_cells, 3);
  EXPECT_EQ(grid.height_cells, 2);
  EXPECT_THAT(grid.occupancy_percent, ElementsAre(0, -1, 100, 100, -1, 0));
  EXPECT_EQ(grid.map_from_grid, (Pose2{1.0, -2.0, 0.0}));
  EXPECT_EQ(grid.resolution_m, 0.1);
  EXPECT_EQ(grid.occupied_from_percent, 65);
  EXPECT_EQ(grid.free_to_percent, 20);
  EXPECT_TRUE(grid.is_occupied(grid.cell_at({1.05, -1.85})));
  EXPECT_TRUE(grid.is_occupied(grid.cell_at({1.25, -1.95})));
}

struct ShadeCase {
  int shade;
  int trinary, trinary_negated, scale, scale_negated, raw, raw_negated;
};

// Recipe: p = 1 - shade / 255 (negated: shade / 255) against 0.65 and 0.196; between them 99 (p - 0.196) /
// 0.454.
TEST(GridIo, ShadesInEachMode) {
  const std::vector<ShadeCase> cases{
      {0, 100, 0, 100, 0, 0, -1},     {1, 100, 0, 100, 0, 1, -1},     {49, 100, 0, 100, 0, 49, -1},
      {50, 100, -1, 100, 0, 50, -1},  {89, 100, -1, 100, 33, 89, -1}, {90, -1, -1, 98, 34, 90, -1},
      {100, -1, -1, 90, 43, 100, -1}, {101, -1, -1, 89, 44, -1, -1},  {128, -1, -1, 66, 67, -1, -1},
      {155, -1, -1, 43, 90, -1, 100}, {165, -1, -1, 34, 98, -1, 90},  {166, -1, 100, 33, 100, -1, 89},
      {205, -1, 100, 0, 100, -1, 50}, {206, 0, 100, 0, 100, -1, 49},  {255, 0, 100, 0, 100, -1, 0}};
  for (const ShadeCase& c : cases) {
    const auto percent = [&](GridMode mode, bool negate) {
      return int{
          occupancy_percent_of(static_cast<std::uint8_t>(c.shade), GridShades{mode, negate, 0.65, 0.196})};
    };
    EXPECT_EQ(percent(GridMode::trinary, false), c.trinary) << c.shade;
    EXPECT_EQ(percent(GridMode::trinary, true), c.trinary_negated) << c.shade;
    EXPECT_EQ(percent(GridMode::scale, false), c.scale) << c.shade;
    EXPECT_EQ(percent(GridMode::scale, true), c.scale_negated) << c.shade;
    EXPECT_EQ(percent(GridMode::raw, false), c.raw) << c.shade;
    EXPECT_EQ(percent(GridMode::raw, true), c.raw_negated) << c.shade;
  }
}

TEST(GridIo, KeysOfTheYamlReachTheCells) {
  const TempFolder folder;
  EXPECT_THAT(grid_of(folder, kHead + "negate: 1\n").occupancy_percent, ElementsAre(100, -1, 0, 0, 100, 100));
  EXPECT_THAT(grid_of(folder, kHead + "mode: scale\n").occupancy_percent, ElementsAre(0, 66, 100, 100, 0, 0));
  EXPECT_THAT(grid_of(folder, kHead + "mode: raw\n").occupancy_percent, ElementsAre(-1, -1, 0, 0, -1, -1));
  EXPECT_THAT(grid_of(folder, kHead + "free_thresh: 0.25\n").occupancy_percent,
              ElementsAre(0, -1, 100, 100, 0, 0));
  EXPECT_THAT(grid_of(folder, kHead + "occupied_thresh: 0.45\nsome_vendor_key: {a: 1}\n").occupancy_percent,
              ElementsAre(0, 100, 100, 100, -1, 0));
}

TEST(GridIo, AThresholdNearZeroDoesNotMakeFreeCellsOccupied) {
  const TempFolder folder;
  const OccupancyGrid grid = grid_of(folder, kHead + "occupied_thresh: 0.002\nfree_thresh: 0.001\n");
  EXPECT_FALSE(grid.is_occupied({0, 0}));
  EXPECT_TRUE(grid.is_free({0, 0}));
  EXPECT_TRUE(grid.is_occupied({2, 0}));
}

TEST(GridIo, TransparencyIsUnknownInScaleModeOnly) {
  const TempFolder folder;
  folder.write("a.png", png({2, 1, 8, 4}, "\0\x00\xFF\x00\xFE"s));
  const std::string yaml = "image: a.png\nresolution: 0.1\norigin: [0, 0, 0]\nmode: ";
  EXPECT_THAT(read_grid(folder.write("a.yaml", yaml + "scale"))->occupancy_percent, ElementsAre(100, -1));
  EXPECT_THAT(read_grid(folder.write("a.yaml", yaml + "trinary"))->occupancy_percent, ElementsAre(100, 100));
}

TEST(GridIo, FindsTheImageBesideTheYamlAndByItsFullPath) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path("pictures"));
  folder.write("pictures/b.pgm", six_pixels());
  const std::string rest = "\nresolution: 0.1\norigin: [0, 0, 0]\n";
  EXPECT_TRUE(read_grid(folder.write("a.yaml", "image: pictures/b.pgm" + rest)));
  EXPECT_TRUE(read_grid(folder.write("a.yaml", "image: " + folder.path("pictures/b.pgm") + rest)));
}

// The same room twice: upright, and with its grid turned by 30 degrees about the map's origin. A point, and
// the same point turned, meet the same cell.
TEST(GridIo, HonoursTheYawOfTheOrigin) {
  const TempFolder folder;
  Rng rng(3);
  std::string shades;
  for (int i = 0; i < 40 * 30; ++i) shades += "\x00\xCD\xFE"s[rng.bits() % 3];
  folder.write("a.pgm", p5(40, 30, shades));
  const double yaw = radians(30.0);
  const Eigen::Vector2d corner = Pose2{0.0, 0.0, yaw} * Eigen::Vector2d(-1.3, 0.7);
  const std::string head = "image: a.pgm\nresolution: 0.1\norigin: ";
  const OccupancyGrid upright = read_grid(folder.write("a.yaml", head + "[-1.3, 0.7, 0.0]\n")).value();
  const OccupancyGrid turned =
      read_grid(folder.write("b.yaml", head + "[" + yaml_number(corner.x()) + ", " + yaml_number(corner.y()) +
                                           ", " + yaml_number(yaw) + "]\n"))
          .value();
  EXPECT_EQ(turned.map_from_grid.theta_rad, yaw);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d point(rng.uniform(-2.0, 4.0), rng.uniform(0.0, 5.0));
    const auto a = upright.at(upright.cell_at(point));
    const auto b = turned.at(turned.cell_at(Pose2{0.0, 0.0, yaw} * point));
    EXPECT_EQ(a, b) << point.transpose();
  }
}

TEST(GridIo, WhatIsWrittenReadsBack) {
  const TempFolder folder;
  Rng rng(4);
  for (const auto& [occupied_from, free_to] : std::vector<std::pair<int, int>>{
           {65, 20}, {65, 25}, {100, 0}, {1, 0}, {50, 49}, {99, 98}, {10, 5}, {100, 99}, {3, 2}}) {
    OccupancyGrid grid{.resolution_m = 0.1 + 1e-9,
                       .map_from_grid = {-1.0 / 3.0, 1e5 / 7.0, -2.9},
                       .width_cells = 13,
                       .height_cells = 7,
                       .occupancy_percent = {},
                       .occupied_from_percent = static_cast<std::int8_t>(occupied_from),
                       .free_to_percent = static_cast<std::int8_t>(free_to)};
    for (int i = 0; i < 13 * 7; ++i)
      grid.occupancy_percent.push_back(std::vector<std::int8_t>{-1, 0, 100}[rng.bits() % 3]);
    ASSERT_TRUE(write_grid(folder.path("my map.yaml"), grid));
    const auto read = read_map(folder.path("my map.yaml"));
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(std::get<OccupancyGrid>(*read), grid) << occupied_from << " " << free_to;
  }
}

TEST(GridIo, WritesAsMapSaverDoes) {
  const TempFolder folder;
  OccupancyGrid grid{.width_cells = 4, .height_cells = 1, .occupancy_percent = {100, 0, -1, 40}};
  ASSERT_TRUE(write_grid(folder.path("m.yaml"), grid));
  EXPECT_EQ(folder.read("m.pgm"), p5(4, 1, "\x00\xFE\xCD\xCD"s));
  EXPECT_THAT(folder.read("m.yaml"), HasSubstr("occupied_thresh: 0.65\nfree_thresh: 0.196\n"));
}

TEST(GridIo, WritingSaysWhyItCannot) {
  const TempFolder folder;
  OccupancyGrid grid{.width_cells = 1, .height_cells = 1, .occupancy_percent = {0}};
  EXPECT_THAT(write_grid(folder.path("m.pgm"), grid).error().remedy, HasSubstr(".yaml"));
  EXPECT_THAT(write_grid(folder.path("gone/m.yaml"), grid).error().where, HasSubstr("gone/m.pgm"));
  grid.occupancy_percent.clear();
  EXPECT_FALSE(write_grid(folder.path("m.yaml"), grid));
}

TEST(GridIo, ErrorsNameLineKeyValueAndWhatIsAllowed) {
  const TempFolder folder;
  folder.write("a.pgm", six_pixels());
  folder.write("bad.pgm", "P5\n65536 65536\n255\n");
  struct Case {
    std::string yaml;
    int line;  // 0: of the file as a whole
    std::string key, value;
  };
  const std::string no_resolution = "image: a.pgm\norigin: [0, 0, 0]\n";
  const std::string no_origin = "image: a.pgm\nresolution: 0.1\n";
  const std::vector<Case> cases{
      {no_resolution, 0, "resolution", ""},
      {no_resolution + "resolution: 0\n", 3, "resolution", "\"0\""},
      {no_resolution + "resolution: -0.05\n", 3, "resolution", "\"-0.05\""},
      {no_resolution + "resolution: 1e30\n", 3, "resolution", "\"1e30\""},
      {no_resolution + "resolution: .nan\n", 3, "resolution", "\".nan\""},
      {no_resolution + "resolution: nan\n", 3, "resolution", "\"nan\""},
      {no_resolution + "resolution: 5 cm\n", 3, "resolution", "\"5 cm\""},
      {no_resolution + "resolution: [1]\n", 3, "resolution", "a list of 1"},
      {no_resolution + "resolution:\n", 3, "resolution", "nothing"},
      {no_origin, 0, "origin", ""},
      {no_origin + "origin: [0, 0]\n", 3, "origin", "a list of 2"},
      {no_origin + "origin: 0\n", 3, "origin", "\"0\""},
      {no_origin + "origin: [0, inf, 0]\n", 3, "origin y", "\"inf\""},
      {no_origin + "origin: [0, 0, 90]\n", 3, "origin yaw", "\"90\""},
      {kHead + "negate: maybe\n", 4, "negate", "\"maybe\""},
      {kHead + "mode: ternary\n", 4, "mode", "\"ternary\""},
      {kHead + "occupied_thresh: 65\n", 4, "occupied_thresh", "\"65\""},
      {kHead + "free_thresh: -0.1\n", 4, "free_thresh", "\"-0.1\""},
      {kHead + "free_thresh: 0.7\n", 0, "free_thresh", "0.7"},
      {"image:\nresolution: 0.1\norigin: [0, 0, 0]\n", 1, "image", "nothing"},
      {"image: gone.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n", 1, "image", "no such file"},
      {"image: .\nresolution: 0.1\norigin: [0, 0, 0]\n", 1, "image", "directory"},
      {"image: bad.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n", 1, "image", "65536 x 65536"},
      {kHead + "image: b.pgm\n", 4, "image", "twice"},
  };
  for (const Case& c : cases) {
    const std::string path = folder.write("a.yaml", c.yaml);
    const auto map = read_map(path);
    ASSERT_FALSE(map) << c.yaml;
    EXPECT_EQ(map.error().where, c.line == 0 ? path : path + ":" + std::to_string(c.line)) << map.error();
    EXPECT_THAT(map.error().what, HasSubstr(c.key)) << map.error();
    EXPECT_THAT(map.error().what, HasSubstr(c.value)) << map.error();
    EXPECT_FALSE(map.error().remedy.empty()) << map.error();
  }
}

TEST(GridIo, ReadsRecordedMaps) {
  const std::string jarvis = recorded("jarvis/maps/i-108_10mm.yaml");
  if (jarvis.empty()) GTEST_SKIP() << "the recorded maps are not here (BEACONLESS_DATA)";
  const OccupancyGrid hall = read_grid(jarvis).value();
  EXPECT_EQ(hall.width_cells, 2051);
  EXPECT_EQ(hall.height_cells, 765);
  for (const char* name :
       {"sim_rooms/a_room4x3_r050.yaml", "turtlebot4/mac_1st_floor_final.yaml", "wean_hall/wean.yaml"}) {
    const OccupancyGrid grid = read_grid(recorded(name)).value();
    const auto occupied = std::count(grid.occupancy_percent.begin(), grid.occupancy_percent.end(), 100);
    const auto free = std::count(grid.occupancy_percent.begin(), grid.occupancy_percent.end(), 0);
    EXPECT_GT(occupied, 100) << name;
    EXPECT_GT(free, 1000) << name;
  }
  // The walls of this room are the lines x = 0, x = 4, y = 0, y = 3.
  const OccupancyGrid room = read_grid(recorded("sim_rooms/a_room4x3_r050.yaml")).value();
  EXPECT_TRUE(room.is_free(room.cell_at({2.0, 1.5})));
  for (const double x : {0.5, 2.0, 3.5}) EXPECT_TRUE(room.is_occupied(room.cell_at({x, 0.0}))) << x;
  EXPECT_FALSE(room.is_occupied(room.cell_at({2.0, 0.3})));
}

}  // namespace
}  // namespace beaconless::io
