// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/relations.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless::eval {
namespace {

Stamp at_s(double seconds_s) { return Stamp::from_seconds(seconds_s); }

Pose2 random_pose(Rng& rng) {
  return {rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0), rng.uniform(-kPi, kPi)};
}

/// A drive of a pose a second, from second 0.
Trajectory drive(int poses, std::uint64_t seed = 1) {
  Rng rng(seed);
  Trajectory trajectory;
  for (int i = 0; i < poses; ++i) trajectory.add(at_s(i), random_pose(rng));
  return trajectory;
}

PoseRelation between(const Trajectory& truth, std::size_t i, std::size_t j) {
  return {truth[i].stamp, truth[j].stamp, truth[i].pose.inverse() * truth[j].pose};
}

TEST(Relations, OfTheTrajectoryItselfHaveNoErrorInWhateverFrame) {
  const Trajectory truth = drive(20);
  std::vector<PoseRelation> relations;
  for (std::size_t i = 0; i < 20; ++i) relations.push_back(between(truth, i, (7 * i + 3) % 20));
  Trajectory moved;
  for (const StampedPose& pose : truth) moved.add(pose.stamp, Pose2{100.0, -50.0, 2.5} * pose.pose);
  const RelationEvaluation evaluation = evaluate_relations(moved, relations);
  EXPECT_EQ(evaluation.errors.size(), 20U);
  EXPECT_EQ(evaluation.relation_count, 20U);
  EXPECT_EQ(evaluation.without_pose_count, 0U);
  EXPECT_LT(evaluation.translation_m.max, 1e-12);
  EXPECT_LT(evaluation.rotation_deg.max, 1e-12);
}

// Slow twin: the error is the motion that is left between where `to` is and where the relation puts it.
TEST(Relations, ErrorIsTheMotionLeftAtTheSecondPose) {
  const Trajectory truth = drive(30);
  const Trajectory estimate = drive(30, 2);
  std::vector<PoseRelation> relations;
  for (std::size_t i = 1; i < 30; ++i) relations.push_back(between(truth, i - 1, i));
  const RelationEvaluation evaluation = evaluate_relations(estimate, relations);
  ASSERT_EQ(evaluation.errors.size(), 29U);
  double sum_m = 0.0;
  for (std::size_t k = 0; k < 29; ++k) {
    const Pose2 expected = estimate[k].pose * relations[k].from_pose_to;
    EXPECT_NEAR(evaluation.errors[k].translation_m, distance_m(expected, estimate[k + 1].pose), 1e-12);
    EXPECT_NEAR(evaluation.errors[k].rotation_deg,
                degrees(heading_difference_rad(expected, estimate[k + 1].pose)), 1e-10);
    sum_m += distance_m(expected, estimate[k + 1].pose);
  }
  EXPECT_NEAR(evaluation.translation_m.mean, sum_m / 29.0, 1e-12);
}

TEST(Relations, TurnsAcrossHalfATurnAreShort) {
  Trajectory estimate;
  estimate.add(at_s(0), {0.0, 0.0, radians(179.0)});
  estimate.add(at_s(1), {0.0, 0.0, radians(-179.0)});
  const PoseRelation relation{at_s(0), at_s(1), {0.0, 0.0, radians(-1.0)}};
  EXPECT_NEAR(evaluate_relations(estimate, {{relation}}).rotation_deg.mean, 3.0, 1e-9);
}

TEST(Relations, ThoseWithoutAPoseAreCountedAndNotGuessed) {
  const Trajectory truth = drive(10);
  PoseRelation early = between(truth, 0, 1);
  early.from = at_s(-0.2);
  PoseRelation late = between(truth, 8, 9);
  late.to = at_s(9.3);
  PoseRelation gap = between(truth, 3, 4);
  gap.to = at_s(4.5);  // as far from pose 4 as from pose 5, and not near
  const RelationEvaluation evaluation = evaluate_relations(truth, {{early, between(truth, 2, 5), late, gap}});
  EXPECT_EQ(evaluation.relation_count, 4U);
  EXPECT_EQ(evaluation.without_pose_count, 3U);
  ASSERT_EQ(evaluation.errors.size(), 1U);
  EXPECT_EQ(evaluation.errors[0].index, 1U);
}

TEST(Relations, TheNearestPoseWithinTheToleranceIsMeant) {
  const Trajectory truth = drive(10);
  PoseRelation shifted = between(truth, 2, 5);
  shifted.from = at_s(2.09);
  shifted.to = at_s(4.92);
  const RelationEvaluation evaluation = evaluate_relations(truth, {{shifted}});
  ASSERT_EQ(evaluation.errors.size(), 1U);
  EXPECT_LT(evaluation.errors[0].translation_m, 1e-12);
  EXPECT_EQ(evaluate_relations(truth, {{shifted}}, {.tolerance_s = 0.05}).without_pose_count, 1U);
  EXPECT_EQ(evaluate_relations(truth, {{between(truth, 2, 5)}}, {.tolerance_s = 0.0}).errors.size(), 1U);
}

TEST(Relations, ClocksMayDiffer) {
  const Trajectory truth = drive(10);
  PoseRelation relation = between(truth, 2, 5);
  relation.from = at_s(1211.5 + 2.0);
  relation.to = at_s(1211.5 + 5.0);
  EXPECT_EQ(evaluate_relations(truth, {{relation}}).without_pose_count, 1U);
  const RelationEvaluation told = evaluate_relations(truth, {{relation}}, {.clock_offset_s = 1211.5});
  ASSERT_EQ(told.errors.size(), 1U);
  EXPECT_LT(told.errors[0].translation_m, 1e-12);
}

TEST(Relations, ScansAreCountedInTheTrajectoryOrByTheirStamps) {
  const Trajectory truth = drive(10);
  PoseRelation relation = between(truth, 2, 5);
  relation.from = std::uint64_t{2};
  relation.to = std::uint64_t{5};
  EXPECT_LT(evaluate_relations(truth, {{relation}}).translation_m.max, 1e-12);

  // A recording of twice as many scans, every second of which has a pose.
  RelationKeys keys;
  for (int i = 0; i < 20; ++i) keys.scan_stamps.push_back(at_s(0.5 * i));
  EXPECT_GT(evaluate_relations(truth, {{relation}}, keys).without_pose_count, 0U);
  relation.from = std::uint64_t{4};
  relation.to = std::uint64_t{10};
  EXPECT_LT(evaluate_relations(truth, {{relation}}, keys).translation_m.max, 1e-12);
  relation.to = std::uint64_t{20};
  EXPECT_EQ(evaluate_relations(truth, {{relation}}, keys).without_pose_count, 1U);
  relation.to = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(evaluate_relations(truth, {{relation}}).without_pose_count, 1U);
}

TEST(Relations, OddInputGivesNoNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(evaluate_relations({}, {}).translation_m, Statistics{});
  const Trajectory truth = drive(4);
  EXPECT_EQ(evaluate_relations({}, {{between(truth, 0, 1)}}).without_pose_count, 1U);
  PoseRelation broken = between(truth, 0, 1);
  broken.from_pose_to.x_m = nan;
  EXPECT_EQ(evaluate_relations(truth, {{broken}}).without_pose_count, 1U);
  Trajectory lost = truth;
  lost.add(at_s(4), {nan, 0.0, 0.0});
  EXPECT_EQ(evaluate_relations(lost, {{{at_s(3), at_s(4), {}}}}).without_pose_count, 1U);
  EXPECT_EQ(evaluate_relations(truth, {{between(truth, 0, 1)}}, {.tolerance_s = nan}).without_pose_count, 1U);
  for (const std::int64_t edge :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(evaluate_relations(truth, {{{Stamp{edge}, at_s(1), {}}}}).without_pose_count, 1U);
}

}  // namespace
}  // namespace beaconless::eval
