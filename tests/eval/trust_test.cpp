// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/trust.hpp"

#include <gtest/gtest.h>

namespace beaconless::eval {
namespace {

PoseEstimate estimate_at(double at_s, double x_m, Status status = Status::ok, double quality = 0.9) {
  PoseEstimate estimate{.stamp = Stamp::from_seconds(at_s),
                        .map_from_base = {x_m, 0.0, kPi - 0.01},
                        .status = status,
                        .reason = "",
                        .quality = quality};
  return estimate;
}

/// A robot that stands at the origin for ten seconds and looks back.
Trajectory standing() {
  Trajectory truth;
  for (int i = 0; i <= 10; ++i) truth.add(Stamp::from_seconds(i), {0.0, 0.0, -kPi + 0.01});
  return truth;
}

TEST(Trust, JudgesPosesThatAreToldAndHaveATruth) {
  const std::vector<PoseEstimate> estimates{estimate_at(1, 0.3),
                                            estimate_at(2, 0.0, Status::relocalizing),
                                            estimate_at(3, 0.0, Status::not_started),
                                            estimate_at(4, 0.0, Status::not_a_scan),
                                            estimate_at(5, -0.2, Status::degraded),
                                            estimate_at(6, 7.0, Status::lost),
                                            estimate_at(99, 0.0)};
  const auto judged = judge_estimates(estimates, standing());
  ASSERT_EQ(judged.size(), 3U);
  EXPECT_EQ(judged[0].stamp, Stamp::from_seconds(1));
  EXPECT_NEAR(judged[0].position_error_m, 0.3, 1e-12);
  EXPECT_NEAR(judged[0].heading_error_rad, 0.02, 1e-12) << "the short way round";
  EXPECT_NEAR(judged[1].position_error_m, 0.2, 1e-12);
  EXPECT_EQ(judged[2].status, Status::lost);
}

JudgedEstimate judged(Status status, double quality, double position_m, double heading_deg = 0.0) {
  return {.status = status,
          .quality = quality,
          .position_error_m = position_m,
          .heading_error_rad = radians(heading_deg)};
}

TEST(Trust, FalseOkIsATrustedPoseThatIsNotNear) {
  const std::vector<JudgedEstimate> estimates{
      judged(Status::ok, 0.5, 0.09),     judged(Status::ok, 0.5, 0.11),  // false
      judged(Status::ok, 0.9, 0.0, 2.1),                                 // false
      judged(Status::ok, 0.49, 5.0),     judged(Status::degraded, 0.9, 5.0),
      judged(Status::lost, 0.9, 5.0),    judged(Status::ok, 1.0, 0.0, 1.9)};
  const Trust trust = trust_of(estimates);
  EXPECT_EQ(trust.trusted_count, 4U);
  EXPECT_EQ(trust.false_ok_count, 2U);
  EXPECT_DOUBLE_EQ(trust.false_ok_ratio(), 0.5);
  EXPECT_EQ(trust_of({}).false_ok_ratio(), 0.0);
}

TEST(Trust, AnErrorBeyondItsProtectionLevelIsAViolation) {
  JudgedEstimate within = judged(Status::ok, 0.9, 0.1, 1.0);
  within.protection_m = 0.11;
  within.protection_rad = radians(1.1);
  JudgedEstimate beside = within;
  beside.protection_m = 0.09;
  JudgedEstimate turned = within;
  turned.protection_rad = radians(0.9);
  JudgedEstimate lost = beside;
  lost.status = Status::lost;
  const JudgedEstimate unbounded = judged(Status::ok, 0.9, 500.0, 170.0);
  const Trust trust = trust_of(std::vector{within, beside, turned, lost, unbounded});
  EXPECT_EQ(trust.bounded_count, 3U);
  EXPECT_EQ(trust.violation_count, 2U);
  EXPECT_DOUBLE_EQ(trust.violation_ratio(), 2.0 / 3.0);
}

TEST(Trust, BinsOfQualityTakeAllFromZeroToOne) {
  const Trust trust = trust_of(std::vector{judged(Status::ok, 0.0, 5.0), judged(Status::ok, 0.05, 0.0),
                                           judged(Status::ok, 1.0, 0.0), judged(Status::ok, 0.95, 5.0),
                                           judged(Status::ok, 0.3, 0.0), judged(Status::lost, -7.0, 0.0)});
  ASSERT_EQ(trust.bins.size(), 10U);
  EXPECT_EQ(trust.bins[0], (QualityBin{0.0, 0.1, 3, 2}));
  EXPECT_EQ(trust.bins[3].count, 1U);
  EXPECT_EQ(trust.bins[9].count, 2U);
  EXPECT_EQ(trust.bins[9].near_count, 1U);
}

}  // namespace
}  // namespace beaconless::eval
