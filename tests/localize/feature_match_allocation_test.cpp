// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/match/match_features.hpp"

#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

TEST(MatchFeatures, AllocatesNothingOnceItsBuffersHaveGrown) {
  Rng rng(1);
  const Pose2 pose{1.0, -2.0, 0.7};
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> second;
  for (int k = 0; k < 12; ++k) {
    first.emplace_back(rng.uniform(0.0, 9.0), rng.uniform(0.0, 6.0));
    second.emplace_back(pose * first.back() + Eigen::Vector2d(rng.normal(0.01), rng.normal(0.01)));
  }
  for (const auto method : {FeatureMatchMethod::mutual_nearest, FeatureMatchMethod::ransac,
                            FeatureMatchMethod::clique, FeatureMatchMethod::hough}) {
    FeatureMatchConfig config;
    config.method = method;
    FeatureMatchScratch scratch;
    FeatureMatch match;
    match_features({.points = first}, {.points = second}, config, {}, pose, scratch, match);
    const std::size_t before = test::allocations();
    ASSERT_GT(before, 0U) << "the counter does not count";
    match_features({.points = first}, {.points = second}, config, {}, pose, scratch, match);
    EXPECT_EQ(test::allocations(), before) << static_cast<int>(method);
    EXPECT_TRUE(match.result.usable());
  }
}

}  // namespace
}  // namespace beaconless
