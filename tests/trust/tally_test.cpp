// SPDX-License-Identifier: Apache-2.0
// What is counted of a run, on records that were made up.
#include "bench/trust/tally.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace beaconless::trust {
namespace {

ScanRecord record(double time_s, Status status, double quality, const Pose2& pose, const Pose2& truth) {
  ScanRecord made{.truth = truth};
  made.estimate.stamp = Stamp::from_seconds(time_s);
  made.estimate.status = status;
  made.estimate.quality = quality;
  made.estimate.map_from_base = pose;
  made.is_right = made.error_m() <= kWrong_m && made.error_rad() <= kWrong_rad;
  return made;
}

TEST(ReliabilityBins, AreTenthsAndTheLastOneHasItsEnd) {
  ReliabilityBins bins;
  for (const double quality : {0.0, 0.05, 0.1, 0.95, 1.0}) bins.add(quality, quality > 0.5);
  EXPECT_EQ(bins.count[0], 2U);
  EXPECT_EQ(bins.count[1], 1U);
  EXPECT_EQ(bins.count[9], 2U);
  EXPECT_EQ(bins.right[0], 0U);
  EXPECT_EQ(bins.right[9], 2U);
}

TEST(LevelBins, AreTenthsOfADecadeFromAMillimetre) {
  LevelBins bins;
  for (const double level_m : {0.0, 0.0011, 0.0105, 1.05, 1000.0, 1e9}) bins.add(level_m);
  EXPECT_EQ(bins.count[0], 2U);
  EXPECT_EQ(bins.count[10], 1U);
  EXPECT_EQ(bins.count[30], 1U);
  EXPECT_EQ(bins.count[59], 2U);
}

TEST(Tally, AWrongPoseIsFalselyOkOnlyWhereItsQualityIsHigh) {
  const Pose2 wrong{1.0, 0.0, 0.0};
  const std::vector<ScanRecord> records{
      record(0.0, Status::ok, 0.9, {}, {}), record(0.1, Status::ok, 0.9, wrong, {}),
      record(0.2, Status::ok, 0.4, wrong, {}), record(0.3, Status::degraded, 0.9, wrong, {})};
  const TrustTally told = tally(records);
  EXPECT_EQ(told.scans, 4U);
  EXPECT_EQ(told.by_status[static_cast<std::size_t>(Status::ok)], 3U);
  EXPECT_EQ(told.ok_wrong, 2U);
  EXPECT_EQ(told.sure, 2U);
  EXPECT_EQ(told.sure_wrong, 1U);
  EXPECT_EQ(told.first_sure_wrong, 1U);
  EXPECT_DOUBLE_EQ(told.worst_sure_wrong_m, 1.0);
  EXPECT_NEAR(told.duration_s, 0.3, 1e-9);
}

TEST(Tally, LostIsCountedOnceUntilItIsOver) {
  std::vector<ScanRecord> records;
  for (const Status status : {Status::ok, Status::lost, Status::lost, Status::ok, Status::lost})
    records.push_back(record(0.1 * static_cast<double>(records.size()), status, 0.9, {}, {}));
  EXPECT_EQ(tally(records).times_lost, 2U);
}

TEST(Tally, AStepThatTheRobotDidNotMakeHasToBeTold) {
  std::vector<ScanRecord> records{record(0.0, Status::ok, 0.9, {0.5, 0.0, 0.0}, {}),
                                  record(0.1, Status::ok, 0.9, {0.1, 0.0, 0.0}, {0.1, 0.0, 0.0})};
  EXPECT_EQ(tally(records).jumps_untold, 1U);
  EXPECT_EQ(tally(records, {.is_followed = false}).jumps_untold, 0U);
  EXPECT_EQ(tally(records, {.reference_m = 0.3}).jumps_untold, 0U);
  records[1].estimate.jumped = true;
  EXPECT_EQ(tally(records).jumps_untold, 0U);
  EXPECT_EQ(tally(records).jumps_told, 1U);
}

TEST(Tally, ALevelIsBrokenWhereTheErrorIsLarger) {
  std::vector<ScanRecord> records(3, record(0.0, Status::ok, 0.9, {0.05, 0.0, 0.0}, {}));
  records[0].estimate.protection_m = 0.06;
  records[1].estimate.protection_m = 0.04;  // the third is not bounded
  const TrustTally told = tally(records);
  EXPECT_EQ(told.bounded, 2U);
  EXPECT_EQ(told.beyond, 1U);
  EXPECT_EQ(tally(records, {.reference_m = 0.02}).beyond, 0U);
}

}  // namespace
}  // namespace beaconless::trust
