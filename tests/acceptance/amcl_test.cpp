// SPDX-License-Identifier: Apache-2.0
// Monte-Carlo localization on real drives with wheels, and on simulated ones without, through the program.
// Skipped where the recordings are not.
#include <gmock/gmock.h>

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

/// A drive, and what is allowed on it.
struct Recorded {
  const char* name;
  const char* method;
  Words words;  ///< files of the recordings begin with @
  const char* reference;
  double least_ok;  ///< share of the scans
  double mean_m;
  double max_m;
  double mean_deg;
};

void PrintTo(const Recorded& of, std::ostream* out) { *out << of.name << " by " << of.method; }

class AmclDrives : public Program, public testing::WithParamInterface<Recorded> {};

TEST_P(AmclDrives, AreFollowedWithinBounds) {
  Words words{"localize"};
  for (const std::string& word : GetParam().words) {
    const bool is_file = word.front() == '@';
    const std::string path = is_file ? recorded(word.substr(1)) : word;
    if (path.empty()) GTEST_SKIP() << word << " is not here; BEACONLESS_DATA names its folder";
#ifndef BEACONLESS_HAS_ROSBAG1
    if (path.ends_with(".bag")) GTEST_SKIP() << "this build reads no ROS 1 bags";
#endif
    words.push_back(path);
  }
  words = words + Words{"--reference", recorded(GetParam().reference),
                        "--method",    GetParam().method,
                        "--out",       folder.path("run"),
                        "--json"};
  const Ran ran = run(words);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto told = ran.json();
  const double scans = told["scans"].get<double>();
  EXPECT_GE(told["status_counts"].value("ok", 0.0), GetParam().least_ok * scans) << told["status_counts"];
  EXPECT_LE(told["error"]["position_m"]["mean"].get<double>(), GetParam().mean_m);
  EXPECT_LE(told["error"]["position_m"]["max"].get<double>(), GetParam().max_m);
  EXPECT_LE(told["error"]["heading_deg"]["mean"].get<double>(), GetParam().mean_deg);
}

const Words kHall{"@jarvis/jarvis_circular_path_fast.bag",
                  "--topic",
                  "/driver_laser_navigation/laser_scan",
                  "--map",
                  "@jarvis/maps/i-108_10mm.yaml",
                  "--base-from-laser",
                  "0.194,0,0",
                  "--stamp-is",
                  "last",
                  "--start-from",
                  "@jarvis/jarvis_circular_gt_plan_frame.tum"};

Words corridor(const std::string& log, const std::string& start) {
  return {"@wean_hall/" + log, "--map", "@wean_hall/wean.yaml", "--base-from-laser", "0.25,0,0",
          "--start",           start};
}

Words room(const std::string& drive, const std::string& map) {
  return {"@sim_rooms/" + drive + ".carmen.log.gz", "--map", "@sim_rooms/" + map, "--start-from",
          "@sim_rooms/" + drive + ".truth.tum"};
}

// Wean Hall's reference is good to 0.1 m and 1°, its map has cells of 0.1 m.
INSTANTIATE_TEST_SUITE_P(
    Recordings, AmclDrives,
    testing::Values(Recorded{"wean_2", "amcl", corridor("robotdata2.carmen.log.gz", "39.70,41.48,265.8"),
                             "wean_hall/robotdata2_derived_ref.tum", 0.97, 0.35, 1.2, 2.5},
                    Recorded{"wean_4", "amcl", corridor("robotdata4.carmen.log.gz", "46.27,39.74,266.4"),
                             "wean_hall/robotdata4_derived_ref.tum", 0.97, 0.35, 1.0, 3.0},
                    Recorded{"hall", "amcl", kHall, "jarvis/jarvis_circular_gt_plan_frame.tum", 0.99, 0.05,
                             0.15, 0.8},
                    Recorded{"hall_polished", "amcl+walls", kHall, "jarvis/jarvis_circular_gt_plan_frame.tum",
                             0.99, 0.03, 0.1, 0.4},
                    Recorded{"standing", "amcl", room("a1_static", "a_room4x3.plan.yaml"),
                             "sim_rooms/a1_static.truth.tum", 1.0, 0.017, 0.05, 0.4},
                    Recorded{"ellipse", "amcl", room("b1_ellipse", "b_room12x8_r050.yaml"),
                             "sim_rooms/b1_ellipse.truth.tum", 1.0, 0.0108, 0.06, 1.0},
                    Recorded{"ellipse_polished", "amcl+walls", room("b1_ellipse", "b_room12x8.plan.yaml"),
                             "sim_rooms/b1_ellipse.truth.tum", 1.0, 0.0006, 0.003, 0.03}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace beaconless
