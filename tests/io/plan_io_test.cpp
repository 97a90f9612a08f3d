// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/plan_io.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::HasSubstr;

TEST(PlanIo, ReadsPolylinesInFlowAndBlockForm) {
  const TempFolder folder;
  const std::string flow = "# a room\nwalls:\n  - [[0, 0], [4, 0.5], [4.0, 3e0]]\n  - [[-1, -1], [1, 1]]\n";
  const std::string block = "walls:\n- - [0, 0]\n  - - 4\n    - 0.5\n  - [4, 3]\n- - [-1, -1]\n  - [1, 1]\n";
  const FloorPlan expected{{{{0, 0}, {4, 0.5}, {4, 3}}, {{-1, -1}, {1, 1}}}};
  EXPECT_EQ(read_plan(folder.write("a.yaml", flow)).value(), expected);
  EXPECT_EQ(read_plan(folder.write("a.yaml", block)).value(), expected);
  EXPECT_EQ(read_plan(folder.write("a.yaml", "\xEF\xBB\xBF---\r\n" + flow)).value(), expected);
  EXPECT_EQ(std::get<FloorPlan>(read_map(folder.path("a.yaml")).value()), expected);
}

TEST(PlanIo, WhatIsWrittenReadsBackBitForBit) {
  const TempFolder folder;
  Rng rng(1);
  FloorPlan plan;
  for (int i = 0; i < 50; ++i) {
    FloorPlan::Polyline wall;
    for (int k = 0; k < 2 + i % 7; ++k) wall.emplace_back(rng.normal(1e3), rng.normal(1e-6));
    plan.walls.push_back(wall);
  }
  ASSERT_TRUE(write_plan(folder.path("a.yaml"), plan));
  EXPECT_EQ(read_plan(folder.path("a.yaml")).value(), plan);
}

TEST(PlanIo, WritingSaysWhyItCannot) {
  const TempFolder folder;
  EXPECT_THAT(write_plan(folder.path("gone/a.yaml"), {}).error().where, HasSubstr("gone/a.yaml"));
}

TEST(PlanIo, ErrorsNameLineValueAndWhatIsAllowed) {
  const TempFolder folder;
  struct Case {
    std::string yaml;
    int line;  // 0: of the file as a whole
    std::string what, remedy;
  };
  const std::string two = "walls:\n  - [[0, 0], [1, 1]]\n";
  const std::vector<Case> cases{
      {"", 0, "nothing", "walls:"},
      {"[]", 0, "a list of 0", "walls:"},
      {"just words", 0, "just words", "walls:"},
      {"wals:\n  - [[0, 0], [1, 1]]\n", 0, "neither walls: nor image:", "walls:"},
      {two + "color: red\n", 3, "\"color\"", "walls"},
      {two + "wall: []\n", 3, "\"wall\"", "did you mean \"walls\"?"},
      {two + "walls: []\n", 3, "twice", ""},
      {two + "image: a.pgm\n", 3, "both", ""},
      {"walls:\n", 1, "nothing", "list of polylines"},
      {"walls: []\n", 1, "a list of 0", "list of polylines"},
      {"walls: 5\n", 1, "\"5\"", "list of polylines"},
      {"walls:\n  - 7\n", 2, "polyline 1", "list of polylines"},
      {two + "  - [[0, 0]]\n", 3, "polyline 2", "two points"},
      {two + "  - []\n", 3, "polyline 2", "two points"},
      {two + "  - [[0, 0], [1]]\n", 3, "point 2", "two numbers"},
      {two + "  - [[0, 0], [1, 2, 3]]\n", 3, "a list of 3", "two numbers"},
      {two + "  - [[0, 0], [1, .nan]]\n", 3, "\".nan\"", "two numbers"},
      {two + "  - [[0, 0],\n     [1, inf]]\n", 4, "\"inf\"", "two numbers"},
      {two + "  - [[0, 0], [1e8, 0]]\n", 3, "\"1e8\"", "1e7"},
      {two + "  - [[0, 0], [a, 0]]\n", 3, "\"a\"", "two numbers"},
      {two + "  - [[0, 0], {x: 1, y: 2}]\n", 3, "a map", "two numbers"},
      {two + "---\n" + two, 3, "second document", ""},
      {"walls: &w\n  - [[0, 0], [1, 1]]\n  - *w\n", 3, "aliases", "write the value out"},
      {"walls: [[[0, 0], [1, 1]\n", 2, "not YAML", ""},
      {"[1, 2]: walls\n", 1, "a key is a list of 2", "keys are words"},
  };
  for (const Case& c : cases) {
    const std::string path = folder.write("a.yaml", c.yaml);
    const auto map = read_map(path);
    ASSERT_FALSE(map) << c.yaml;
    EXPECT_EQ(map.error().where, c.line == 0 ? path : path + ":" + std::to_string(c.line)) << map.error();
    EXPECT_THAT(map.error().what, HasSubstr(c.what)) << map.error();
    EXPECT_THAT(map.error().remedy, HasSubstr(c.remedy)) << map.error();
  }
}

TEST(PlanIo, RefusesWhatIsNoYamlFile) {
  const TempFolder folder;
  EXPECT_THAT(read_map(folder.path("gone.yaml")).error().what, HasSubstr("no such file"));
  EXPECT_THAT(read_map(folder.path("")).error().what, HasSubstr("directory"));
  EXPECT_THAT(read_map(folder.write("a.pgm", "P5")).error().remedy, HasSubstr("YAML"));
  EXPECT_FALSE(read_map(folder.write("a.bag", std::string("#ROSBAG V2.0\n\0\1\2", 16))));
  EXPECT_THAT(read_map(folder.write("big.yaml", std::string(kMaxYamlBytes + 1, '\n'))).error().what,
              HasSubstr("bytes"));
}

TEST(PlanIo, RefusesDeepNestsQuickly) {
  const TempFolder folder;
  for (const char* open : {"[", "{a: ", "- ", "? "}) {
    std::string deep = "walls:\n";
    for (int i = 0; i < 100000; ++i) deep += open;
    EXPECT_FALSE(read_map(folder.write("a.yaml", deep))) << open;
  }
}

TEST(PlanIo, SurvivesDamage) {
  const TempFolder folder;
  const std::string whole =
      "# plan\nwalls:\n  - [[0.25, 0], [4, 0.5], [4.0, 3e0]]\n  - [[-1, -1], [1, \"1\"]]\n";
  ASSERT_TRUE(read_plan(folder.write("a.yaml", whole)));
  for (std::size_t size = 0; size < whole.size(); ++size)
    (void)read_map(folder.write("a.yaml", whole.substr(0, size)));
  Rng rng(2);
  for (int i = 0; i < 5000; ++i) {
    std::string changed = whole;
    for (int k = 0; k <= i % 4; ++k) changed[rng.bits() % changed.size()] = static_cast<char>(rng.bits());
    const auto plan = read_plan(folder.write("a.yaml", changed));
    if (!plan) continue;
    for (const auto& wall : plan->walls) {
      EXPECT_GE(wall.size(), 2U);
      for (const auto& corner : wall) EXPECT_TRUE(corner.allFinite());
    }
  }
}

TEST(PlanIo, ReadsTheRecordedPlans) {
  const std::string path = recorded("sim_rooms/a_room4x3.plan.yaml");
  if (path.empty()) GTEST_SKIP() << "the recorded plans are not here (BEACONLESS_DATA)";
  EXPECT_EQ(read_plan(path).value(), (FloorPlan{{{{0, 0}, {4, 0}, {4, 3}, {0, 3}, {0, 0}}}}));
  EXPECT_GT(read_plan(recorded("sim_rooms/b_room12x8.plan.yaml")).value().walls.size(), 9U);
}

}  // namespace
}  // namespace beaconless::io
