// SPDX-License-Identifier: Apache-2.0
// Errors are as large as their covariance says and no larger than the Cramér-Rao bound allows, wherever the
// robot stands.
#include <gtest/gtest.h>

#include "beaconless/io/plan_io.hpp"

#include "tests/support/wall_room.hpp"

namespace beaconless {
namespace {

struct World {
  const char* name;
  FloorPlan plan;
};

void PrintTo(const World& world, std::ostream* out) { *out << world.name; }

FloorPlan read(const std::string& name) {
  return io::read_plan(std::string(BEACONLESS_SOURCE_DIR) + "/data/plans/" + name + ".yaml").value();
}

class WallsHonesty : public testing::TestWithParam<World> {
 protected:
  /// Fits from anywhere in the world, from guesses so far off to each side, in metres and radians.
  test::Trial trial(double off, double prior_m, std::uint64_t seed) const {
    test::WallRoom room(GetParam().plan, seed);
    test::Trial all;
    for (int run = 0; run < 1500; ++run) {
      const Pose2 truth = room.anywhere();
      const RawScan raw = room.see(truth);
      const MatchResult match = room.match(raw, room.near(truth, off, off), prior_m);
      EXPECT_EQ(match.rank, 3) << truth;
      all.add(match, truth, room.bound(truth));
    }
    return all;
  }

  static void expect_honest(const test::Trial& trial) {
    EXPECT_NEAR(trial.mean_nees(), 3.0, trial.nees_slack());
    EXPECT_LE(trial.outside, trial.most_outside()) << "of " << trial.count;
    EXPECT_LE(trial.position_ratio(), 1.10);
    EXPECT_LE(trial.heading_ratio(), 1.10);
    RecordProperty("mean_nees", std::to_string(trial.mean_nees()));
    RecordProperty("position_ratio", std::to_string(trial.position_ratio()));
    RecordProperty("heading_ratio", std::to_string(trial.heading_ratio()));
    RecordProperty("outside", trial.outside);
  }
};

TEST_P(WallsHonesty, FromWhereARobotIsPredicted) { expect_honest(trial(0.003, 0.01, 1001)); }

TEST_P(WallsHonesty, FromARoughGuess) { expect_honest(trial(0.02, 0.1, 1002)); }

INSTANTIATE_TEST_SUITE_P(
    Worlds, WallsHonesty,
    testing::Values(World{"rectangle", test::rectangle(10, 6)}, World{"niche_room", test::niche_room()},
                    World{"hall", test::rectangle(30, 20)}, World{"rack_hall", test::rack_hall()},
                    World{"l_room", test::l_room()}, World{"cluttered_room", read("room-full")}),
    [](const auto& world) { return std::string(world.param.name); });

}  // namespace
}  // namespace beaconless
