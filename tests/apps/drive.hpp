// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/apps/program.hpp"

namespace beaconless {

/// test::niche_room() as a file.
inline constexpr const char* kNicheRoom =
    "walls:\n"
    "  - [[0, 0], [6, 0], [6, 2], [7.5, 2], [7.5, 3.2], [6, 3.2], [6, 5], [0, 5], [0, 0]]\n"
    "  - [[2.0, 3.4], [2.5, 3.4], [2.5, 3.9], [2.0, 3.9], [2.0, 3.4]]\n";

/// A test with a second of driving through a room without symmetry: 40 scans, the laser 0.7 m ahead.
class Drive : public Program {
 protected:
  void SetUp() override {
    folder.write("room.yaml", kNicheRoom);
    folder.write("elsewhere.yaml", "walls:\n  - [[50, 50], [53, 50], [53, 54], [50, 54], [50, 50]]\n");
    const std::string scenario = folder.write(
        "drive.yaml",
        "plan: room.yaml\nduration_s: 1\nseed: 5\nlidar: {sweep: instantaneous}\n"
        "path: {kind: ellipse, center_x_m: 3, center_y_m: 2.2, semi_axis_x_m: 1.2, semi_axis_y_m: 0.8, "
        "start_deg: -90, speed_mps: 0.5}\n");
    const Ran simulated = run({"simulate", scenario, "--out", folder.path("sim")});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  }

  static constexpr std::size_t kScans = 40;

  std::string recording() const { return folder.path("sim/recording.log.gz"); }
  std::string truth() const { return folder.path("sim/truth.tum"); }
  std::string plan() const { return folder.path("sim/plan.yaml"); }

  /// `localize` in the room, from its true start.
  Words localize() const { return localize_on(plan()); }
  Words localize_on(const std::string& map) const {
    return {"localize", recording(), "--map", map, "--base-from-laser", "0.7,0,0", "--start-from", truth()};
  }
};

}  // namespace beaconless
