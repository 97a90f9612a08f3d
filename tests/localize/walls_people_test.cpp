// SPDX-License-Identifier: Apache-2.0
// People cover beams, more and more of them: the pose may become worse, but not without being told.
#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/people.hpp"
#include "tests/support/wall_room.hpp"

namespace beaconless {
namespace {

class CrowdedRoom : public testing::TestWithParam<int> {};  // per cent of the beams on people

TEST_P(CrowdedRoom, IsNeverOkAndFarFromTheTruth) {
  test::WallRoom room(test::niche_room(), 91);
  const auto localizer = make_localizer({.method = "walls"}, room.plan).value();
  const double share = 0.01 * GetParam();
  std::int64_t tick = 0;
  int ok = 0;
  int judged = 0;
  int wrong = 0;
  int wrong_and_ok = 0;
  for (int run = 0; run < 300; ++run) {
    const Pose2 truth = room.anywhere();
    localizer->start_at(room.near(truth, 0.15, 0.1));
    for (int scan = 0; scan < 5; ++scan) {
      RawScan raw = test::among_people(room.see(truth), share, room.rng);
      raw.stamp = {25'000'000 * tick++};
      const PoseEstimate estimate = localizer->update(Scan::make(raw).value());
      const bool is_wrong = distance_m(estimate.map_from_base, truth) > 0.10;
      ++judged;
      ok += estimate.ok() ? 1 : 0;
      wrong += is_wrong ? 1 : 0;
      wrong_and_ok += is_wrong && estimate.ok() ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong_and_ok, 0) << "of " << judged;
  RecordProperty("ok", ok);
  RecordProperty("wrong", wrong);
  if (GetParam() <= 20) EXPECT_EQ(ok, judged);
}

INSTANTIATE_TEST_SUITE_P(Shares, CrowdedRoom, testing::Values(20, 40, 60),
                         [](const auto& share) { return "percent_" + std::to_string(share.param); });

}  // namespace
}  // namespace beaconless
