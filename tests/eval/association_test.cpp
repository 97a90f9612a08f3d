// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/association.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace beaconless::eval {
namespace {

Stamp at_s(double seconds) { return Stamp::from_seconds(seconds); }

TEST(Associate, InterpolatesTheReference) {
  const Trajectory reference({{at_s(1.0), {0.0, 0.0, 0.0}}, {at_s(2.0), {2.0, 0.0, 0.0}}});
  const Trajectory estimate({{at_s(1.25), {9.0, 9.0, 1.0}}});
  const Association found = associate(estimate, reference);
  ASSERT_EQ(found.pairs.size(), 1U);
  EXPECT_EQ(found.pairs[0].estimate, (Pose2{9.0, 9.0, 1.0}));
  EXPECT_NEAR(found.pairs[0].reference.x_m, 0.5, 1e-12);
  EXPECT_EQ(found.pairs[0].stamp, at_s(1.25));
}

TEST(Associate, LeavesOutWhatTheReferenceDoesNotCover) {
  const Trajectory reference({{at_s(1.0), {}}, {at_s(2.0), {}}, {at_s(5.0), {}}});
  const Trajectory estimate(
      {{at_s(0.9), {}}, {at_s(1.5), {}}, {at_s(3.0), {}}, {at_s(5.0), {}}, {at_s(5.1), {}}});
  const Association found = associate(estimate, reference);
  ASSERT_EQ(found.pairs.size(), 2U);
  EXPECT_EQ(found.pairs[0].stamp, at_s(1.5));
  EXPECT_EQ(found.pairs[1].stamp, at_s(5.0));
  EXPECT_EQ(found.unmatched_count, 3U);
  EXPECT_EQ(associate(estimate, reference, 3.5).unmatched_count, 2U);
}

TEST(Associate, RepeatedStampsPairInOrder) {
  const Trajectory reference(
      {{at_s(1), {1, 0, 0}}, {at_s(2), {2, 0, 0}}, {at_s(2), {3, 0, 0}}, {at_s(3), {4, 0, 0}}});
  const Trajectory estimate(
      {{at_s(1), {}}, {at_s(1), {}}, {at_s(2), {}}, {at_s(2), {}}, {at_s(2), {}}, {at_s(3), {}}});
  const Association found = associate(estimate, reference);
  std::vector<double> x_m;
  for (const PosePair& pair : found.pairs) x_m.push_back(pair.reference.x_m);
  EXPECT_EQ(x_m, (std::vector<double>{1, 1, 2, 3, 3, 4}));
}

TEST(Associate, TakesNothingAndWhatIsNoPose) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Trajectory one({{at_s(1), {1, 0, 0}}});
  EXPECT_EQ(associate({}, one), Association{});
  EXPECT_EQ(associate(one, {}).unmatched_count, 1U);
  const Trajectory bad({{at_s(1), {nan, 0, 0}}});
  EXPECT_EQ(associate(bad, one), (Association{{}, 1}));
  EXPECT_EQ(associate(one, bad), (Association{{}, 1}));
}

}  // namespace
}  // namespace beaconless::eval
