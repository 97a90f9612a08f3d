// SPDX-License-Identifier: Apache-2.0
// What `beaconless map build --slam` promises.
#include <cmath>
#include <fstream>
#include <set>

#include <gmock/gmock.h>

#include "beaconless/eval/evaluate.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

/// A drive whose poses nobody knows.
class MapSlam : public Drive {
 protected:
  Words slam(const Words& more = {}) const {
    return Words{"map",     "build", recording(), "--slam", "hector", "--base-from-laser",
                 "0.7,0,0", "--out", map()} +
           more;
  }
  std::string map() const { return folder.path("hall.yaml"); }
  std::string poses() const { return folder.path("hall.tum"); }
};

TEST_F(MapSlam, WritesTheMapAndThePosesWithoutHavingBeenToldAny) {
  const Ran ran = run(slam({"--out-poses", poses(), "--json"}));
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto told = ran.json();
  std::set<std::string> keys;
  for (const auto& [key, value] : told.items()) keys.insert(key);
  EXPECT_EQ(keys, (std::set<std::string>{"out", "width_cells", "height_cells", "resolution_m", "scans",
                                         "drawn", "length_m", "status_counts", "update_us"}));
  EXPECT_EQ(told["scans"], kScans);
  EXPECT_EQ(told["status_counts"], (nlohmann::json{{"ok", kScans}}));
  EXPECT_NEAR(told["length_m"].get<double>(), io::read_tum(truth()).value().length_m(), 0.1);

  const auto evaluation = eval::evaluate(io::read_tum(poses()).value(), io::read_tum(truth()).value());
  EXPECT_EQ(evaluation.errors.size(), kScans);
  EXPECT_LT(evaluation.aligned.position_m.max, 0.02);

  const auto grid = io::read_map(map());
  ASSERT_TRUE(grid) << grid.error();
  ASSERT_TRUE(std::holds_alternative<OccupancyGrid>(*grid));
  const auto& cells = std::get<OccupancyGrid>(*grid);
  EXPECT_EQ(cells.width_cells, told["width_cells"]);
  EXPECT_EQ(cells.resolution_m, 0.05);
}

TEST_F(MapSlam, ItsMapIsOneToLocalizeIn) {
  ASSERT_EQ(run(slam({"--out-poses", poses()})).exit_code, 0);
  const Ran ran = run({"localize", recording(), "--map", map(), "--base-from-laser", "0.7,0,0", "--start",
                       "0,0,0", "--reference", poses(), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_LT(ran.json()["error"]["position_m"]["max"].get<double>(), 0.05);
}

TEST_F(MapSlam, PeopleReadWhatBecameOfTheScans) {
  const Ran ran = run(slam({"--out-poses", poses()}));
  EXPECT_THAT(ran.out, HasSubstr("40 scans"));
  EXPECT_THAT(ran.out, HasSubstr("40 ok"));
  EXPECT_THAT(ran.out, HasSubstr("update: median"));
  EXPECT_THAT(ran.out, HasSubstr("hall.tum"));
}

TEST_F(MapSlam, TakesTheLasersPlaceFromALogThatTellsIt) {
  // A robot that turns about its base, half a metre behind the laser, in the corner of a room.
  std::string log;
  for (int i = 0; i < 30; ++i) {
    const double heading = 0.05 * i;
    const Pose2 base{2.0, 1.5, heading};
    const Pose2 laser = base * Pose2{0.5, 0.0, 0.0};
    log += "FLASER 181";
    for (int k = 0; k <= 180; ++k) {
      const double bearing = laser.theta_rad + radians(k - 90.0);
      const double to_x = (std::cos(bearing) > 0.0 ? 6.0 - laser.x_m : -laser.x_m) / std::cos(bearing);
      const double to_y = (std::sin(bearing) > 0.0 ? 4.0 - laser.y_m : -laser.y_m) / std::sin(bearing);
      log += " " + std::to_string(std::min(to_x, to_y));
    }
    for (const Pose2& pose : {laser, base})
      log += " " + std::to_string(pose.x_m) + " " + std::to_string(pose.y_m) + " " +
             std::to_string(pose.theta_rad);
    log += " " + std::to_string(0.1 * i) + " host " + std::to_string(0.1 * i) + "\n";
  }
  const Ran ran = run({"map", "build", folder.write("turn.log", log), "--slam", "hector", "--out", map(),
                       "--out-poses", poses()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto found = io::read_tum(poses()).value();
  ASSERT_EQ(found.size(), 30U);
  for (const StampedPose& pose : found)
    EXPECT_LT(std::hypot(pose.pose.x_m, pose.pose.y_m), 0.1) << "the laser moved by 0.7 m, the base did not";
  EXPECT_THAT(ran.err, HasSubstr("0.500,0.000,0.0"));
}

TEST_F(MapSlam, PlotsTheMapWithThePath) {
  ASSERT_EQ(run(slam({"--plot", folder.path("hall.svg")})).exit_code, 0);
  EXPECT_THAT(folder.read("hall.svg"), HasSubstr("<svg"));
  EXPECT_THAT(folder.read("hall.svg"), HasSubstr("image/png"));
}

TEST_F(MapSlam, StartsWhereItIsTold) {
  ASSERT_EQ(run(slam({"--out-poses", poses(), "--start", "3,-4,90"})).exit_code, 0);
  const Pose2 first = io::read_tum(poses()).value().front().pose;
  EXPECT_NEAR(first.x_m, 3.0, 1e-9);
  EXPECT_NEAR(first.y_m, -4.0, 1e-9);
  EXPECT_NEAR(degrees(first.theta_rad), 90.0, 1e-6);
}

TEST_F(MapSlam, OptionsAndParametersReachIt) {
  const auto told = run(slam({"--resolution", "0.1", "--scans", "0:20", "--json"})).json();
  EXPECT_EQ(told["resolution_m"], 0.1);
  EXPECT_EQ(told["scans"], 20);
  // Parameters come after options, and the later word wins.
  const std::string config =
      folder.write("slam.yaml", "hector_slam:\n  update_distance_m: 0\n  map: {resolution_m: 0.2}\n");
  const auto all = run(slam({"--config", config, "--json"})).json();
  EXPECT_EQ(all["drawn"], kScans);
  EXPECT_EQ(all["resolution_m"], 0.2);
  EXPECT_EQ(run(slam({"--config", config, "--set", "hector_slam.map.resolution_m=0.025", "--json"}))
                .json()["resolution_m"],
            0.025);
}

TEST_F(MapSlam, TheSameBytesTwice) {
  ASSERT_EQ(run(slam({"--out-poses", poses()})).exit_code, 0);
  const std::string once = folder.read("hall.pgm") + folder.read("hall.tum");
  ASSERT_EQ(run(slam({"--out-poses", poses()})).exit_code, 0);
  EXPECT_EQ(folder.read("hall.pgm") + folder.read("hall.tum"), once);
}

TEST_F(MapSlam, WordsThatMakeNoSense) {
  const auto refused = [&](const Words& words, int exit_code, const char* says) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(says));
    EXPECT_EQ(ran.out, "");
  };
  refused(slam({"--poses", "recorded"}), 2, "--slam");
  refused({"map", "build", recording(), "--out", map(), "--out-poses", poses()}, 2, "--slam");
  refused({"map", "build", recording(), "--out", map(), "--set", "hector_slam.guess=odometry"}, 2, "--slam");
  refused({"map", "build", recording(), "--out", map(), "--slam", "hektor"}, 2, "hector");
  refused(slam({"--set", "hector_slam.gues=odometry"}), 2, "hector_slam.guess");
  refused(slam({"--set", "hector_slam.map.levels=0"}), 2, "1 … 8");
  refused(slam({"--resolution", "-1"}), 2, "resolution_m");
  refused(slam({"--start", "1,2"}), 2, "--start");
  refused(slam({"--out-poses", map()}), 2, "same file");
  refused(slam({"--plot", map()}), 2, "same file");
  refused(slam({"--out-poses", recording()}), 2, "written over");
  refused({"map", "build", recording(), "--out", map(), "--plot", folder.path("a.svg")}, 2, "--slam");
  refused(slam({"--out-poses", folder.path("no/such.tum")}), 3, "folder");
  refused({"map", "build", folder.path("missing.log"), "--slam", "hector", "--out", map()}, 3, "missing.log");
}

/// Scans of a square room of 4 m, then of noise.
TEST_F(MapSlam, ARobotThatIsLostAtTheEndIsToldAndTheMapIsWrittenAllTheSame) {
  std::string log;
  const auto scan = [&](int index, auto range) {
    log += "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) log += " " + std::to_string(range(beam));
    log += " 0 0 0 0 0 0 " + std::to_string(0.1 * index) + " host " + std::to_string(0.1 * index) + "\n";
  };
  for (int i = 0; i < 5; ++i)
    scan(i, [](int beam) {
      const double angle = radians(beam - 89.5);
      return 2.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    });
  for (int i = 5; i < 20; ++i) scan(i, [](int beam) { return 0.5 + (beam * 7919 % 100) * 0.012; });
  const Ran ran = run({"map", "build", folder.write("lost.log", log), "--slam", "hector", "--out", map()});
  EXPECT_EQ(ran.exit_code, 4) << ran.out;
  EXPECT_THAT(ran.err, HasSubstr("lost"));
  EXPECT_TRUE(io::read_map(map()));
}

TEST_F(MapSlam, ARecordingWithoutAnythingToDrawIsAnError) {
  const Ran ran =
      run({"map", "build", folder.write("empty.log", "FLASER 3 81.9 81.9 81.9 0 0 0 0 0 0 1 host 1\n"),
           "--slam", "hector", "--max-range", "80", "--out", map()});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr("no scan began a map"));
}

TEST_F(MapSlam, ReferenceOfItsParametersIsUpToDate) {
  std::ifstream in(BEACONLESS_SOURCE_DIR "/docs/reference/slam-parameters.md", std::ios::binary);
  ASSERT_TRUE(in.good());
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string table = run({"params", "--slam", "--markdown"}).out;
  EXPECT_THAT(table, HasSubstr("| `hector_slam.map.resolution_m` |"));
  EXPECT_THAT(page, HasSubstr(table)) << "put the output of `beaconless params --slam --markdown` there";
}

}  // namespace
}  // namespace beaconless
