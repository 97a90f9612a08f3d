// SPDX-License-Identifier: Apache-2.0
// The example that the README shows, run on a simulated recording.
#ifdef BEACONLESS_EXAMPLE_01

#include <gmock/gmock.h>

#include "beaconless/io/tum.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using Example = Program;

TEST_F(Example, LocalizesARecordingWhoseLaserIsTheRobot) {
  const std::string scenario = folder.write(
      "turn.yaml",
      "plan: plan.yaml\nduration_s: 1\nbase_from_laser: [0, 0, 0]\n"
      "lidar: {sweep: instantaneous}\n"
      "path: {kind: turning, x_m: 1.2, y_m: 1.4, heading_deg: 90, angle_deg: 40, rate_degps: 45}\n");
  folder.write("plan.yaml", "walls:\n  - [[0, 0], [3.6, 0], [3.6, 2.8], [0, 2.8], [0, 0]]\n");
  ASSERT_EQ(run({"simulate", scenario, "--out", folder.path("sim")}).exit_code, 0);
  const Ran ran = run_program(folder, BEACONLESS_EXAMPLE_01,
                              {folder.path("sim/recording.log.gz"), folder.path("sim/plan.yaml"), "1.2",
                               "1.4", "90", folder.path("out.tum")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto found = io::read_tum(folder.path("out.tum")).value();
  const auto truth = io::read_tum(folder.path("sim/truth.tum")).value();
  ASSERT_EQ(found.size(), 40U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    // Ten times the bound of a scan in this room, which is below a millimetre and half a milliradian.
    EXPECT_LT((found[i].pose.translation() - truth[i].pose.translation()).norm(), 0.01);
    EXPECT_LT(std::abs(wrap_angle(found[i].pose.theta_rad - truth[i].pose.theta_rad)), 0.005);
  }
}

TEST_F(Example, SaysWhatIsWrong) {
  EXPECT_EQ(run_program(folder, BEACONLESS_EXAMPLE_01, {}).exit_code, 2);
  const Ran ran =
      run_program(folder, BEACONLESS_EXAMPLE_01,
                  {folder.path("none"), folder.path("none"), "0", "0", "0", folder.path("o.tum")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, testing::HasSubstr("none"));
}

}  // namespace
}  // namespace beaconless

#endif
