// SPDX-License-Identifier: Apache-2.0
// What beaconless is measured by: real drives and independent simulations, through the program, with the
// bounds that its README speaks of. Skipped where the recordings are not.
#include <gmock/gmock.h>

#include "beaconless/eval/evaluate.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

/// Runs the program on recordings below BEACONLESS_DATA.
class Drives : public Program {
 protected:
  /// `localize` with the words given; checks that the robot is not lost at the end.
  nlohmann::json localize(const Words& words) const {
    const Ran ran = run(Words{"localize"} + words + Words{"--out", folder.path("run"), "--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.json().is_object() ? ran.json() : nlohmann::json{{"status_counts", nlohmann::json::object()}};
  }

  std::string build_map(const Words& words) const {
    const Ran ran = run(Words{"map", "build"} + words + Words{"--out", folder.path("grid.yaml")});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return folder.path("grid.yaml");
  }
};

#define SKIP_WITHOUT(name) \
  if (recorded(name).empty()) GTEST_SKIP() << (name) << " is not here; BEACONLESS_DATA names its folder"

/// A room simulated by an independent program.
struct Room {
  const char* drive;
  const char* room;
  std::size_t scans;
  double rmse_m;    ///< allowed on the plan
  double ratio;     ///< of `walls` to the bound, allowed on the plan
  double fine_m;    ///< RMSE of the best other program on a grid of 2.5 cm …
  double coarse_m;  ///< … and of 5 cm
};

void PrintTo(const Room& room, std::ostream* out) { *out << room.drive; }

class SimulatedRoom : public Drives, public testing::WithParamInterface<Room> {
 protected:
  Words words_on(const std::string& map) const {
    const std::string drive = std::string("sim_rooms/") + GetParam().drive;
    return {recorded(drive + ".carmen.log.gz"),
            "--map",
            recorded("sim_rooms/" + (GetParam().room + map)),
            "--start-from",
            recorded(drive + ".truth.tum"),
            "--reference",
            recorded(drive + ".truth.tum")};
  }
};

TEST_P(SimulatedRoom, EveryScanIsOkOnItsPlan) {
  SKIP_WITHOUT("sim_rooms");
  const auto told = localize(words_on(".plan.yaml"));
  EXPECT_EQ(told["scans"], GetParam().scans);
  EXPECT_EQ(told["status_counts"], (nlohmann::json{{"ok", GetParam().scans}}));
  EXPECT_EQ(told["error"]["pairs"], GetParam().scans);
  EXPECT_LE(told["error"]["position_m"]["rmse"].get<double>(), GetParam().rmse_m);
  // No single scan beats the bound; the RMSE of 400 errors scatters by 1 / sqrt(800), 3.5 %.
  // error.
  EXPECT_GT(told["error"]["crb_ratio"]["position"].get<double>(), 0.9);
}

/// Every scan's own estimate, none left out.
TEST_P(SimulatedRoom, WallsReachTheBoundOnItsPlan) {
  SKIP_WITHOUT("sim_rooms");
  const auto told = localize(words_on(".plan.yaml") + Words{"--method", "walls"});
  EXPECT_EQ(told["status_counts"], (nlohmann::json{{"ok", GetParam().scans}}));
  EXPECT_EQ(told["error"]["pairs"], GetParam().scans);
  EXPECT_LE(told["error"]["crb_ratio"]["position"].get<double>(), GetParam().ratio);
  EXPECT_LE(told["error"]["crb_ratio"]["heading"].get<double>(), GetParam().ratio);
  // Four times the bound's sigma, 0.63 and 0.46 mm, and a millimetre.
  EXPECT_LE(told["error"]["position_m"]["max"].get<double>(), 4.0 * 0.46e-3 + 1e-3);
}

TEST_P(SimulatedRoom, NoOtherProgramIsNearerOnItsGrids) {
  SKIP_WITHOUT("sim_rooms");
  for (const auto& [grid, best_m] :
       {std::pair{"_r025.yaml", GetParam().fine_m}, std::pair{"_r050.yaml", GetParam().coarse_m}}) {
    const auto told = localize(words_on(grid));
    EXPECT_EQ(told["status_counts"], (nlohmann::json{{"ok", GetParam().scans}})) << grid;
    EXPECT_LE(told["error"]["position_m"]["rmse"].get<double>(), best_m) << grid;
  }
}

// The bound for a1 is 0.63 mm. Its walls run along the grid of 5 cm and are drawn 12.5 mm off to two sides:
// nobody is nearer than 17.7 mm there, and that is told with no more digits.
INSTANTIATE_TEST_SUITE_P(Rooms, SimulatedRoom,
                         testing::Values(Room{"a1_static", "a_room4x3", 400, 0.0010, 1.05, 0.0035, 0.0178},
                                         Room{"b1_ellipse", "b_room12x8", 2000, 0.0015, 1.10, 0.00073,
                                              0.0012}),
                         [](const auto& room) { return std::string(room.param.drive); });

/// A tricycle AGV in a hall; a bag, so only where bags can be read.
class Hall : public Drives {
 protected:
  void SetUp() override {
#ifndef BEACONLESS_HAS_ROSBAG1
    GTEST_SKIP() << "this build reads no ROS 1 bags";
#endif
    SKIP_WITHOUT("jarvis/jarvis_circular_path_fast.bag");
  }
  std::string bag() const { return recorded("jarvis/jarvis_circular_path_fast.bag"); }
  std::string reflectors() const { return recorded("jarvis/jarvis_circular_gt_plan_frame.tum"); }

  void expect_localized(const nlohmann::json& told, std::size_t scans) const {
    EXPECT_EQ(told["scans"], scans);
    EXPECT_FALSE(told["status_counts"].contains("lost")) << told["status_counts"];
    EXPECT_GE(told["error"]["pairs"].get<double>(), 0.95 * static_cast<double>(scans));
    EXPECT_LE(told["error"]["aligned"]["position_m"]["mean"].get<double>(), 0.04);
  }
};

TEST_F(Hall, HighScannerOnAPlanDrawnByHand) {
  const auto told =
      localize({bag(), "--topic", "/driver_laser_navigation/laser_scan", "--map",
                recorded("jarvis/maps/i-108_10mm.yaml"), "--base-from-laser", "0.194,0,0", "--stamp-is",
                "last", "--start-from", reflectors(), "--reference", reflectors()});
  expect_localized(told, 204);
  EXPECT_LE(told["error"]["aligned"]["position_m"]["mean"].get<double>(), 0.015);
  EXPECT_LE(told["error"]["heading_deg"]["mean"].get<double>(), 0.25);
}

TEST_F(Hall, LowScannerOnAGridOfItsOwnEvenScans) {
  const Words scanner{bag(), "--topic", "/driver_laser_security/laser_scan", "--base-from-laser",
                      "0.895,0,0"};
  const std::string grid = build_map(scanner + Words{"--poses", reflectors(), "--scans", "0::2"});
  const auto told = localize(scanner + Words{"--map", grid, "--scans", "1::2", "--start-from", reflectors(),
                                             "--reference", reflectors()});
  expect_localized(told, 106);
}

TEST_F(Drives, ABuildingByEverySecondScanOnAGridOfTheOthers) {
  const char* name = "fr079/freiburg-079-corrected.log.gz";
  SKIP_WITHOUT(name);
  const std::string log = recorded(name);
  const std::string grid = build_map({log, "--poses", "recorded", "--scans", "0::2"});
  ASSERT_EQ(run({"poses", log, "--out", folder.path("poses.tum")}).exit_code, 0);
  const auto told = localize({log, "--map", grid, "--scans", "1::2", "--start-from", "recorded"});
  const double scans = told["scans"].get<double>();
  EXPECT_EQ(scans, 2395.0);

  const auto evaluation = eval::evaluate(io::read_tum(folder.path("run/trajectory.tum")).value(),
                                         io::read_tum(folder.path("poses.tum")).value());
  double near = 0.0;
  for (const eval::PoseError& error : evaluation.errors)
    if (error.position_m() <= 0.20 && std::abs(degrees(error.heading_rad)) <= 3.0) ++near;
  EXPECT_GE(near, 0.99 * scans);
  EXPECT_FALSE(told["status_counts"].contains("lost")) << told["status_counts"];
}

/// The log's own poses, those of a SLAM, miss the relations by 0.059 m and 0.71 degrees on average.
TEST_F(Drives, ABuildingByEveryScanKeepsTheOfficialRelations) {
  const char* name = "fr079/freiburg-079-corrected.log.gz";
  SKIP_WITHOUT(name);
  const std::string log = recorded(name);
  const std::string grid = build_map({log, "--poses", "recorded", "--scans", "0::2"});
  const auto located = localize({log, "--map", grid, "--start-from", "recorded"});
  EXPECT_FALSE(located["status_counts"].contains("lost")) << located["status_counts"];
  const auto told = run({"--json", "evaluate", folder.path("run/trajectory.tum"), "--relations",
                         recorded("fr079/fr079.relations.scanindex"), "--recording", log})
                        .json();
  EXPECT_EQ(told["relations"], 1638) << told;
  EXPECT_LT(told["translation_m"]["mean"].get<double>(), 0.059);
  EXPECT_LT(told["rotation_deg"]["mean"].get<double>(), 0.71);
}

}  // namespace
}  // namespace beaconless
