// SPDX-License-Identifier: Apache-2.0
// Maps made without poses, of real drives: what they and the poses found on the way are worth.
#include <gmock/gmock.h>

#include "beaconless/eval/evaluate.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

class Slam : public Program {
 protected:
  /// `map build --slam hector` with the words given.
  nlohmann::json build(const Words& words) const {
    const Ran ran = run(Words{"map", "build"} + words +
                        Words{"--slam", "hector", "--out", map(), "--out-poses", poses(), "--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.json().is_object() ? ran.json() : nlohmann::json{{"status_counts", nlohmann::json::object()}};
  }
  std::string map() const { return folder.path("map.yaml"); }
  std::string poses() const { return folder.path("poses.tum"); }
  double width_m(const nlohmann::json& told) const {
    return told["width_cells"].get<double>() * told["resolution_m"].get<double>();
  }
};

#define SKIP_WITHOUT(name) \
  if (recorded(name).empty()) GTEST_SKIP() << (name) << " is not here; BEACONLESS_DATA names its folder"

// Published (Kümmerle et al. 2009): scan matching 0.258 ± 0.427 m, GMapping 0.061 ± 0.044 m, graph mapping
// 0.056 ± 0.042 m.
TEST_F(Slam, ABuildingByItsLaserAloneKeepsTheOfficialRelations) {
  SKIP_WITHOUT("fr079/freiburg-079-corrected.log.gz");
  const auto told = build({recorded("fr079/freiburg-079-corrected.log.gz")});
  EXPECT_EQ(told["scans"], 4791);
  EXPECT_FALSE(told["status_counts"].contains("lost")) << told["status_counts"];
  EXPECT_GE(told["status_counts"]["ok"], 4650);
  const Ran ran =
      run({"evaluate", poses(), "--relations", recorded("fr079/fr079.relations.scanindex"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["without_pose"], 0);
  EXPECT_LE(ran.json()["translation_m"]["mean"].get<double>(), 0.056);
  EXPECT_LE(ran.json()["translation_m"]["max"].get<double>(), 0.5);
  EXPECT_LE(ran.json()["rotation_deg"]["mean"].get<double>(), 0.7);
}

// Every third scan: 1.4 Hz, with turns of up to 30 degrees from one to the next.
TEST_F(Slam, EveryThirdScanWillDo) {
  SKIP_WITHOUT("fr079/freiburg-079-corrected.log.gz");
  const std::string log = recorded("fr079/freiburg-079-corrected.log.gz");
  const auto told = build({log, "--scans", "0::3"});
  EXPECT_FALSE(told["status_counts"].contains("lost")) << told["status_counts"];
  const Ran ran = run({"evaluate", poses(), "--relations", recorded("fr079/fr079.relations.scanindex"),
                       "--recording", log, "--tolerance", "0.001", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_GT(ran.json()["relations"].get<double>() - ran.json()["without_pose"].get<double>(), 80.0);
  EXPECT_LE(ran.json()["translation_m"]["mean"].get<double>(), 0.08);
}

// The hallways make a ring of about 20 x 15 m. Its own walls do not tell how far the robot has come along
// them; with the wheels the ring closes.
TEST_F(Slam, AHallwayWithHelpFromTheWheels) {
  SKIP_WITHOUT("duke_loop5/loop5.carmen.log.gz");
  const Words log{recorded("duke_loop5/loop5.carmen.log.gz"), "--max-range", "8.1"};
  const auto alone = build(log);
  EXPECT_FALSE(alone["status_counts"].contains("lost")) << alone["status_counts"];
  EXPECT_GT(alone["status_counts"]["degraded"], 20);
  EXPECT_NEAR(width_m(alone), 29.0, 4.0);
  const auto wheels =
      build(log + Words{"--base-from-laser", "0.4,0,0", "--set", "hector_slam.guess=odometry"});
  const Trajectory path = io::read_tum(poses()).value();
  // The first hallway was left at scan 60, to the west; the last scans come back into it from the east.
  const Pose2 there = path[30].pose;
  const Pose2 again = path[path.size() - 1].pose;
  const Eigen::Vector2d off =
      Pose2{0.0, 0.0, there.theta_rad}.rotation().transpose() * (again.translation() - there.translation());
  EXPECT_LT(std::abs(off.y()), 1.0) << "beside the hallway";
  EXPECT_LT(degrees(heading_difference_rad(there, again)), 10.0);
}

TEST_F(Slam, AScannerCarriedByHand) {
#ifndef BEACONLESS_HAS_ROSBAG1
  GTEST_SKIP() << "this build reads no ROS 1 bags";
#endif
  SKIP_WITHOUT("hand_carried/laser_scan_matcher_demo.bag");
  const std::string bag = recorded("hand_carried/laser_scan_matcher_demo.bag");
  const auto told = build({bag});
  EXPECT_EQ(told["scans"], 360);
  EXPECT_GE(told["status_counts"]["ok"], 355);
  EXPECT_LT(width_m(told), 6.0) << "one room";
  // A quarter of the scans tells the same path.
  const Trajectory all = io::read_tum(poses()).value();
  const auto few = build({bag, "--scans", "0::4"});
  const auto evaluation = eval::evaluate(io::read_tum(poses()).value(), all);
  EXPECT_LT(evaluation.raw.position_m.rmse, 0.02);
  EXPECT_LT(evaluation.raw.heading_deg.rmse, 0.5);
}

// Reflectors tell this robot's path to 4 mm; its scans take 125 ms each, in which it drives 10 cm and turns 5
// degrees, and are matched as if taken at once.
TEST_F(Slam, ATricycleInAHall) {
#ifndef BEACONLESS_HAS_ROSBAG1
  GTEST_SKIP() << "this build reads no ROS 1 bags";
#endif
  SKIP_WITHOUT("jarvis/jarvis_circular_path_fast.bag");
  for (const Words& scanner :
       {Words{"--topic", "/driver_laser_navigation/laser_scan", "--base-from-laser", "0.194,0,0"},
        Words{"--topic", "/driver_laser_security/laser_scan", "--base-from-laser", "0.895,0,0"}}) {
    const auto told = build(Words{recorded("jarvis/jarvis_circular_path_fast.bag")} + scanner);
    EXPECT_GE(told["status_counts"]["ok"].get<double>(), 0.95 * told["scans"].get<double>());
    const auto evaluation =
        eval::evaluate(io::read_tum(poses()).value(),
                       io::read_tum(recorded("jarvis/jarvis_circular_gt_nav350_frame.tum")).value());
    EXPECT_LT(evaluation.aligned.position_m.rmse, 0.05);
    EXPECT_LT(evaluation.aligned.heading_deg.rmse, 3.0);
  }
}

// From the true start; what hector_slam reaches on the same scans.
TEST_F(Slam, SimulatedRoomsBetterThanHectorSlam) {
  SKIP_WITHOUT("sim_rooms/b1_ellipse.carmen.log.gz");
  for (const auto& [room, hector_slam_m] : {std::pair{"a1_static", 0.0163}, {"b1_ellipse", 0.0080}}) {
    const std::string drive = std::string("sim_rooms/") + room;
    const Trajectory truth = io::read_tum(recorded(drive + ".truth.tum")).value();
    const Pose2 start = truth.front().pose;
    const auto told = build({recorded(drive + ".carmen.log.gz"),
                             "--start=" + std::to_string(start.x_m) + "," + std::to_string(start.y_m) + "," +
                                 std::to_string(degrees(start.theta_rad))});
    EXPECT_EQ(told["status_counts"], (nlohmann::json{{"ok", told["scans"]}}));
    const auto evaluation = eval::evaluate(io::read_tum(poses()).value(), truth);
    EXPECT_LT(evaluation.raw.position_m.rmse, hector_slam_m) << room;
  }
}

}  // namespace
}  // namespace beaconless
