// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

TEST(IcpLocalizer, AllocatesNothingPerScanWhileItTracks) {
  Rng rng(3);
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const auto localizer = make_localizer({}, plan).value();
  localizer->start_at({3, 2, 0});
  std::vector<Event> scans;
  for (int i = 0; i < 20; ++i)
    scans.emplace_back(
        Scan::make(test::sweep(walls, {3.0 + 0.01 * i, 2, 0}, 0.01, rng, {25'000'000 * i})).value());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(localizer->update(scans[static_cast<std::size_t>(i)]).ok());
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  for (std::size_t i = 5; i < scans.size(); ++i) localizer->update(scans[i]);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
