// SPDX-License-Identifier: Apache-2.0
// The verbs that make and look at files: simulate, map build, poses, info, doctor, demo.
#include <gmock/gmock.h>

#include "beaconless/io/map_io.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

using Files = Drive;
using Simulate = Program;

TEST_F(Simulate, WritesARecordingItsTruthAndItsPlan) {
  const Ran ran = run({"simulate", "small-rotation", "--out", folder.path("sim"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto files = ran.json();
  const auto recording = io::open_recording(files["recording"]).value();
  const auto truth = io::read_tum(files["truth"]).value();
  std::size_t scans = 0;
  for (const Event& event : recording) {
    const auto* scan = std::get_if<Scan>(&event);
    ASSERT_NE(scan, nullptr);
    EXPECT_EQ(scan->size(), 1081U);
    ASSERT_LT(scans, truth.size());
    EXPECT_EQ(scan->stamp(), truth[scans++].stamp);
  }
  EXPECT_EQ(scans, 400U);  // 10 s at 40 Hz
  EXPECT_EQ(truth.size(), 400U);
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    turned_rad += wrap_angle(truth[i].pose.theta_rad - truth[i - 1].pose.theta_rad);
    EXPECT_NEAR((truth[i].pose.translation() - truth[0].pose.translation()).norm(), 0.0, 1e-8);
  }
  // 400 headings, each rounded to 1e-9 twice over.
  EXPECT_NEAR(std::abs(degrees(turned_rad)), 360.0, 0.5);
  EXPECT_TRUE(std::holds_alternative<FloorPlan>(io::read_map(files["plan"]).value()));
  EXPECT_EQ(files["base_from_laser"], "0.7,0,0");
}

TEST_F(Simulate, SeedDecidesTheBytes) {
  const auto recording = [&](const char* out, const Words& more) {
    EXPECT_EQ(run(Words{"simulate", "small-static", "--out", folder.path(out)} + more).exit_code, 0);
    return folder.read(std::string(out) + "/recording.log.gz");
  };
  const std::string first = recording("a", {"--seed", "3"});
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, recording("b", {"--seed", "3"}));
  EXPECT_NE(first, recording("c", {"--seed", "4"}));
}

TEST_F(Simulate, AMisspeltScenarioGetsAHint) {
  const Ran ran = run({"simulate", "small-rotatoin", "--out", folder.path("sim")});
  EXPECT_NE(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr("did you mean \"small-rotation\"?"));
}

TEST_F(Simulate, DemoEndsWithAReport) {
  const Ran ran = run({"demo", "--out", folder.path("demo")});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("480 scans by walls: 480 ok"));
  EXPECT_THAT(ran.out, HasSubstr(folder.path("demo/report.html")));
  EXPECT_THAT(folder.read("demo/report.html"), HasSubstr("</html>"));
}

TEST_F(Files, AGridOfTheDriveServesToLocalizeIt) {
  const Ran built = run({"map", "build", recording(), "--poses", truth(), "--base-from-laser", "0.7,0,0",
                         "--resolution", "0.02", "--out", folder.path("grid.yaml"), "--json"});
  ASSERT_EQ(built.exit_code, 0) << built.err;
  EXPECT_EQ(built.json()["scans"], kScans);
  EXPECT_EQ(built.json()["without_pose"], 0U);
  EXPECT_EQ(built.json()["resolution_m"], 0.02);
  // What stands in the grid stands on the plan: within noise and half a cell's diagonal of a wall.
  const auto map = io::read_map(folder.path("grid.yaml")).value();
  const auto& grid = std::get<OccupancyGrid>(map);
  const auto room = io::read_map(plan()).value();
  const auto walls = std::get<FloorPlan>(room).segments();
  std::size_t occupied = 0;
  for (int y = 0; y < grid.height_cells; ++y) {
    for (int x = 0; x < grid.width_cells; ++x) {
      if (!grid.is_occupied({x, y})) continue;
      ++occupied;
      double nearest_m = 1e9;
      const Eigen::Vector2d at = grid.center({x, y});
      for (const Segment2& wall : walls) nearest_m = std::min(nearest_m, wall.distance_m(at));
      EXPECT_LT(nearest_m, 5 * 0.01 + 0.02 * M_SQRT1_2);
    }
  }
  EXPECT_GT(occupied, 300U);

  const Ran ran = run(localize_on(folder.path("grid.yaml")) + Words{"--reference", truth(), "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["status_counts"], (nlohmann::json{{"ok", kScans}}));
  // Half a cell is what a grid may hide.
  EXPECT_LT(ran.json()["error"]["position_m"]["max"].get<double>(), 0.01);
  EXPECT_TRUE(ran.json()["error"]["crb_ratio"].is_null());
}

TEST_F(Files, ScansWithoutAPoseAreCounted) {
  const std::string half = folder.write("half.tum", "0 3 1.4 0 0 0 0 1\n0.25 3.1 1.4 0 0 0 0 1\n");
  const Ran ran =
      run({"map", "build", recording(), "--poses", half, "--out", folder.path("grid.yaml"), "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["scans"], 11U);  // 0 to 0.25 s at 40 Hz, both ends
  EXPECT_EQ(ran.json()["without_pose"], 29U);
  EXPECT_THAT(ran.err, HasSubstr("29 scans have no pose"));
}

TEST_F(Files, PosesOfARecordingServeAsStartAndReference) {
  std::string log;
  for (int i = 0; i < 5; ++i) {
    const std::string t = std::to_string(10 + i);
    log += "FLASER 3 1 1 1 " + std::to_string(i) + " 2 0.5 " + std::to_string(i) + " 2 0.5 " + t + " robot " +
           t + "\n";
  }
  const std::string path = folder.write("drive.log", log);
  const Ran ran = run({"poses", path, "--out", folder.path("poses.tum"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["poses"], 5U);
  EXPECT_EQ(ran.json()["source"], "FLASER");
  EXPECT_NEAR(ran.json()["length_m"].get<double>(), 4.0, 1e-12);
  const auto poses = io::read_tum(folder.path("poses.tum")).value();
  ASSERT_EQ(poses.size(), 5U);
  EXPECT_NEAR(poses[3].pose.x_m, 3.0, 1e-9);
  EXPECT_NEAR(poses[3].pose.theta_rad, 0.5, 1e-8);
  const Ran map =
      run({"map", "build", path, "--poses", "recorded", "--out", folder.path("m.yaml"), "--json"});
  EXPECT_EQ(map.json()["scans"], 5U) << map.err;
}

TEST_F(Files, WithoutRecordedPosesThereIsAWord) {
  for (const Words& words : std::vector<Words>{
           {"poses", recording(), "--out", folder.path("p.tum")},
           {"map", "build", recording(), "--poses", "recorded", "--out", folder.path("m.yaml")},
           {"localize", recording(), "--map", plan(), "--start-from", "recorded"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 3) << words.front();
    EXPECT_THAT(ran.err, HasSubstr(recording() + ": the recording carries no poses"));
  }
}

TEST_F(Files, InfoTellsWhatIsInARecordingAPlanAndAGrid) {
  const auto log = run({"info", recording(), "--json"}).json();
  EXPECT_EQ(log["kind"], "recording");
  EXPECT_EQ(log["format"], "CARMEN log");
  EXPECT_EQ(log["scans"], kScans);
  EXPECT_EQ(log["beams"], 1081U);
  EXPECT_NEAR(log["rate_hz"].get<double>(), 40.0, 1e-9);
  EXPECT_EQ(log["hits"].get<std::size_t>() + log["no_returns"].get<std::size_t>() +
                log["too_close"].get<std::size_t>() + log["invalid"].get<std::size_t>(),
            kScans * 1081U);
  const auto walls = run({"info", plan(), "--json"}).json();
  EXPECT_EQ(walls["kind"], "floor plan");
  EXPECT_EQ(walls["walls"], 12U);
  EXPECT_NEAR(walls["length_m"].get<double>(), 25.0 + 2.0, 1e-9);  // the room's outline and the pillar's
  folder.write("g.pgm", "P5\n3 2\n255\n\x01\xfe\xcd\x01\x01\xfe");
  const auto grid =
      run({"info", folder.write("g.yaml", "image: g.pgm\nresolution: 0.1\norigin: [1, 2, 0]\n"), "--json"})
          .json();
  EXPECT_EQ(grid["kind"], "occupancy grid");
  EXPECT_EQ(grid["width_cells"], 3);
  EXPECT_EQ(grid["height_cells"], 2);
  EXPECT_EQ(grid["occupied"], 3U);
  EXPECT_EQ(grid["free"], 2U);
}

TEST_F(Files, DoctorNamesTheDamage) {
  const std::string log = folder.write(
      "hurt.log", "FLASER 3 1 1 1 0 0 0 0 0 0 1 r 1\nFLASER 3 1 1\nFLASER 3 1 1 1 0 0 0 0 0 0 2 r 2\n");
  const Ran ran = run({"doctor", log, "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  ASSERT_EQ(ran.json()["problems"].size(), 1U);
  EXPECT_THAT(ran.json()["problems"][0].get<std::string>(), HasSubstr(log + ":2:"));
  EXPECT_FALSE(ran.json()["findings"].empty());
  EXPECT_EQ(run({"doctor", plan()}).exit_code, 0);
}

}  // namespace
}  // namespace beaconless
