// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/people.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

Pose2 at(double time_s) {
  return {3.0 + 1.2 * std::cos(0.4 * time_s), 2.2 + 0.9 * std::sin(0.4 * time_s), 0.4 * time_s + 1.57};
}

/// The errors of a tracked drive among people against their levels.
struct Tracked {
  int ok = 0;
  int beyond = 0;
  int bounded = 0;

  explicit Tracked(const std::string& method) {
    const FloorPlan plan = test::niche_room();
    const RayCaster walls(plan.segments());
    Rng rng(5);
    auto localizer = make_localizer({.method = method}, plan).value();
    localizer->start_at(at(0.0));
    for (int i = 0; i < 300; ++i) {
      const double time_s = 0.05 * i;
      const RawScan raw = test::among_people(
          test::sweep(walls, at(time_s), 0.01, rng, Stamp::from_seconds(time_s)), 0.2, rng);
      const PoseEstimate estimate = localizer->update(Scan::make(raw).value());
      EXPECT_TRUE(std::isfinite(estimate.protection_m) && estimate.protection_m > 0.0);
      EXPECT_LE(estimate.protection_m, PoseEstimate::kUnbounded_m);
      EXPECT_LE(estimate.protection_rad, kPi);
      if (!estimate.ok()) continue;
      ++ok;
      bounded += estimate.protection_m < 0.5 ? 1 : 0;
      beyond += distance_m(estimate.map_from_base, at(time_s)) > estimate.protection_m ||
                        heading_difference_rad(estimate.map_from_base, at(time_s)) > estimate.protection_rad
                    ? 1
                    : 0;
    }
  }
};

TEST(Protection, HoldsOnATrackedDriveAmongPeople) {
  const Tracked walls("walls");
  EXPECT_GT(walls.ok, 250);
  EXPECT_EQ(walls.beyond, 0);
  EXPECT_GT(walls.bounded, walls.ok / 2);
}

TEST(Protection, IsUnboundedByMethodsThatTellNone) {
  const Tracked icp("icp-full");
  EXPECT_GT(icp.ok, 250);
  EXPECT_EQ(icp.bounded, 0);
}

TEST(Protection, IsUnboundedWhereTheRobotIsLost) {
  const FloorPlan plan = test::niche_room();
  const RayCaster elsewhere(test::rectangle(17, 11).segments());
  Rng rng(6);
  auto localizer = make_localizer({}, plan).value();
  localizer->start_at(at(0.0));
  PoseEstimate last;
  for (int i = 0; i < 20; ++i)
    last = localizer->update(
        Scan::make(test::sweep(elsewhere, {8, 5, 0}, 0.01, rng, Stamp::from_seconds(0.05 * i))).value());
  ASSERT_EQ(last.status, Status::lost);
  EXPECT_EQ(last.protection_m, PoseEstimate::kUnbounded_m);
  EXPECT_EQ(last.protection_rad, kPi);
}

}  // namespace
}  // namespace beaconless
