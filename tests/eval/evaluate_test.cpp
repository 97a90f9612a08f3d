// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/evaluate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/eval/alignment.hpp"

namespace beaconless::eval {
namespace {

Stamp at_s(double seconds) { return Stamp::from_seconds(seconds); }

/// A circle of 3 m radius in 10 s, far from the origin.
Pose2 circling(double time_s) {
  const double angle = 0.2 * kPi * time_s;
  return Pose2{500.0, -300.0, 0.0} * Pose2{0.0, 0.0, angle} * Pose2{3.0, 0.0, kPi / 2.0};
}

Trajectory drive(const std::function<Pose2(double)>& pose, double step_s = 0.1) {
  Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(10.0 / step_s); ++i)
    trajectory.add(at_s(i * step_s), pose(i * step_s));
  return trajectory;
}

TEST(Evaluate, OfItselfIsZero) {
  const Trajectory reference = drive(circling);
  const Evaluation e = evaluate(reference, reference);
  EXPECT_EQ(e.raw.position_m.count, 101U);
  EXPECT_EQ(e.raw.position_m.max, 0.0);
  EXPECT_EQ(e.raw.heading_deg.max, 0.0);
  EXPECT_NEAR(e.aligned.position_m.max, 0.0, 1e-10);
  EXPECT_EQ(e.unmatched_count, 0U);
  EXPECT_EQ(evaluate({}, reference), Evaluation{});
}

TEST(Evaluate, AConstantOffsetIsFoundAndAlignedAway) {
  const Trajectory reference = drive(circling);
  const Trajectory estimate = drive([](double t) { return Pose2{0.03, -0.04, 0.0} * circling(t); });
  const Evaluation e = evaluate(estimate, reference);
  EXPECT_NEAR(e.raw.position_m.mean, 0.05, 1e-10);
  EXPECT_NEAR(e.raw.position_m.rmse, 0.05, 1e-10);
  EXPECT_NEAR(e.raw.position_m.sd, 0.0, 1e-10);
  EXPECT_NEAR(e.raw.heading_deg.max, 0.0, 1e-10);
  EXPECT_NEAR(e.aligned.position_m.max, 0.0, 1e-10);
}

TEST(Evaluate, AlignmentRecoversAKnownMotion) {
  const Pose2 moved{12.0, -7.0, 2.5};
  const Trajectory reference = drive(circling);
  const Evaluation e = evaluate(drive([&](double t) { return moved * circling(t); }), reference);
  EXPECT_GT(e.raw.position_m.mean, 1.0);
  EXPECT_NEAR(e.aligned.position_m.max, 0.0, 1e-9);
  EXPECT_NEAR(e.aligned.heading_deg.max, 0.0, 1e-9);
  const Pose2 back = e.reference_from_estimate * moved;
  EXPECT_NEAR(heading_difference_rad(back, {}), 0.0, 1e-12);
}

TEST(Evaluate, AlignmentIsTheBestThereIs) {
  Rng rng(3);
  const Trajectory reference = drive(circling);
  const Trajectory estimate = drive([&](double t) {
    return circling(t) * Pose2{rng.normal(0.1), rng.normal(0.1), 0.0};
  });
  const Evaluation e = evaluate(estimate, reference);
  const auto rmse_with = [&](const Pose2& nudge) {
    // About the middle of the circle, where turning and shifting do not mix.
    const Pose2 middle{500.0, -300.0, 0.0};
    Trajectory nudged;
    for (const auto& [stamp, pose] : estimate)
      nudged.add(stamp, middle * nudge * middle.inverse() * e.reference_from_estimate * pose);
    return evaluate(nudged, reference).raw.position_m.rmse;
  };
  for (const Pose2& nudge : {Pose2{1e-3, 0, 0}, Pose2{-1e-3, 0, 0}, Pose2{0, 1e-3, 0}, Pose2{0, -1e-3, 0},
                             Pose2{0, 0, 1e-3}, Pose2{0, 0, -1e-3}})
    EXPECT_GT(rmse_with(nudge), e.aligned.position_m.rmse);
}

TEST(Evaluate, ARobotThatStandsIsAlignedByItsHeadings) {
  Rng rng(4);
  const Pose2 stand{1.0, 2.0, 0.3};
  const Trajectory reference = drive([&](double) { return stand; });
  const Trajectory estimate = drive([&](double) {
    return stand * Pose2{0.02 + rng.normal(1e-4), rng.normal(1e-4), radians(0.5) + rng.normal(1e-5)};
  });
  const Evaluation e = evaluate(estimate, reference);
  EXPECT_NEAR(e.raw.position_m.mean, 0.02, 1e-4);
  EXPECT_NEAR(e.raw.heading_deg.mean, 0.5, 1e-3);
  EXPECT_NEAR(e.reference_from_estimate.theta_rad, radians(-0.5), 1e-5);
  EXPECT_LT(e.aligned.position_m.max, 6e-4);
  EXPECT_LT(e.aligned.heading_deg.max, degrees(6e-5));
}

TEST(Evaluate, ComparesAtTheEstimatesOwnMoments) {
  // The reference comes at 2 Hz, the estimates in between; a circle is a constant twist, so nothing is lost.
  const Evaluation e = evaluate(drive(circling, 0.07), drive(circling, 0.5));
  EXPECT_EQ(e.unmatched_count, 0U);
  EXPECT_LT(e.raw.position_m.max, 1e-6);
  EXPECT_LT(e.raw.heading_deg.max, 1e-6);
}

TEST(Align, NoPairsNoMotion) { EXPECT_EQ(align({}), Pose2{}); }

}  // namespace
}  // namespace beaconless::eval
