// SPDX-License-Identifier: Apache-2.0
// What is said of a carry, on records that were made up; and that a case follows from its seed.
#include "bench/trust/kidnapping.hpp"

#include <gtest/gtest.h>

#include "bench/trust/simulated_trial.hpp"

namespace beaconless::trust {
namespace {

/// Scans every 0.5 s, carried before the third.
std::vector<ScanRecord> records_of(const std::vector<Status>& statuses, const std::vector<double>& errors_m) {
  std::vector<ScanRecord> records;
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    ScanRecord record;
    record.estimate.stamp = Stamp::from_seconds(0.5 * static_cast<double>(i));
    record.estimate.status = statuses[i];
    record.estimate.quality = 0.9;
    record.estimate.map_from_base = {errors_m[i], 0.0, 0.0};
    record.is_right = errors_m[i] < kWrong_m;
    records.push_back(record);
  }
  return records;
}

TEST(CarryVerdict, TellsWhenItWasNoticedAndWhenItWasOver) {
  const Kidnapping kidnapping{.trial = {}, .carried_at = 2, .carry_m = 5.0, .carry_rad = 0.0};
  const CarryVerdict verdict = judge(
      kidnapping, records_of({Status::ok, Status::ok, Status::ok, Status::degraded, Status::lost, Status::ok},
                             {0.0, 0.0, 5.0, 5.0, 5.0, 0.2}));
  EXPECT_TRUE(verdict.was_ok);
  EXPECT_EQ(verdict.degraded_s, 0.5);
  EXPECT_EQ(verdict.noticed_s, 1.0);
  EXPECT_EQ(verdict.recovered_s, 1.5);
  EXPECT_EQ(verdict.wrong_ok, 2U);  // found to 0.3 m is not yet right to 0.1 m
  EXPECT_EQ(verdict.last_wrong_ok_s, 1.5);
}

TEST(CarryVerdict, SaysWhereTheRobotWasNotKnownBefore) {
  const Kidnapping kidnapping{.trial = {}, .carried_at = 2, .carry_m = 5.0, .carry_rad = 0.0};
  EXPECT_FALSE(judge(kidnapping, records_of({Status::ok, Status::ok, Status::lost}, {0.0, 1.0, 5.0})).was_ok);
}

TEST(SimulatedTrial, FollowsFromItsSeed) {
  const Trial once = simulated_trial(8);
  const Trial again = simulated_trial(8);
  EXPECT_EQ(once.truth, again.truth);
  EXPECT_EQ(once.events, again.events);
  EXPECT_EQ(*once.map, *again.map);
  EXPECT_NE(once.truth, simulated_trial(48).truth);
}

TEST(SimulatedTrial, KindsAndFamiliesTakeTurns) {
  EXPECT_EQ(kind_of(1), Kind::people);
  EXPECT_EQ(kind_of(100'007), Kind::mirrored);
  EXPECT_EQ(family_of(9), Family::room);
  EXPECT_EQ(family_of(10), Family::racks);
  EXPECT_EQ(family_of(40), Family::room);
}

}  // namespace
}  // namespace beaconless::trust
