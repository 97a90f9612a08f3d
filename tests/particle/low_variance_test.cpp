// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/low_variance.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

std::vector<double> uneven_weights(Rng& rng, std::size_t count) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < count; ++i) weights.push_back(i % 7 == 3 ? 0.0 : std::pow(rng.uniform(), 3.0));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<std::size_t> drawn_times(const std::vector<double>& weights, std::size_t count, double offset) {
  std::vector<std::size_t> times(weights.size());
  comb_weights(weights, count, offset, [&](std::size_t i, std::size_t n) { times[i] += n; });
  return times;
}

TEST(LowVariance, DrawsEachTheWholeNumberOfTimesBesideItsShare) {
  Rng rng(1);
  for (const std::size_t count : {1U, 5U, 100U, 5000U}) {
    const auto weights = uneven_weights(rng, 200);
    const auto times = drawn_times(weights, count, rng.uniform());
    EXPECT_EQ(std::accumulate(times.begin(), times.end(), std::size_t{0}), count);
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_LT(std::abs(static_cast<double>(times[i]) - weights[i] * static_cast<double>(count)),
                1.0 + 1e-9);
  }
}

/// How often each is drawn in many runs is what its weight says: the fractions left over are won by chance.
TEST(LowVariance, IsUnbiased) {
  Rng rng(2);
  constexpr std::size_t kCount = 10;
  constexpr int kRuns = 20'000;
  const auto weights = uneven_weights(rng, 60);
  std::vector<double> times(weights.size());
  for (int run = 0; run < kRuns; ++run) {
    const auto drawn = drawn_times(weights, kCount, rng.uniform());
    for (std::size_t i = 0; i < drawn.size(); ++i) times[i] += static_cast<double>(drawn[i]);
  }
  // Each count is a whole number plus a coin of known chance: its variance is known.
  double chi_square = 0.0;
  int degrees = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = weights[i] * kCount;
    const double chance = expected - std::floor(expected);
    if (weights[i] == 0.0) {
      EXPECT_EQ(times[i], 0.0);
    }
    if (chance * (1.0 - chance) < 1e-3) continue;
    const double off = times[i] - kRuns * expected;
    chi_square += off * off / (kRuns * chance * (1.0 - chance));
    ++degrees;
  }
  EXPECT_GT(degrees, 30);
  EXPECT_LT(chi_square / degrees, 1.6);
  EXPECT_GT(chi_square / degrees, 0.5);
}

TEST(LowVariance, WeightsAddUpToOne) {
  Rng rng(3);
  Particles from;
  for (const double weight : uneven_weights(rng, 100)) from.add({rng.uniform(), rng.uniform(), 0.0}, weight);
  Particles drawn;
  draw_low_variance(from, 333, rng.uniform(), drawn);
  ASSERT_EQ(drawn.size(), 333U);
  EXPECT_NEAR(std::accumulate(drawn.weight.begin(), drawn.weight.end(), 0.0), 1.0, 1e-12);
}

TEST(LowVariance, EffectiveCountIsThatOfEqualWeights) {
  EXPECT_DOUBLE_EQ(effective_count(std::vector<double>(40, 1.0 / 40)), 40.0);
  EXPECT_DOUBLE_EQ(effective_count(std::vector<double>{0.0, 1.0, 0.0}), 1.0);
  EXPECT_NEAR(effective_count(std::vector<double>{0.5, 0.25, 0.25}), 1.0 / 0.375, 1e-12);
  EXPECT_EQ(effective_count(std::vector<double>{}), 0.0);
}

}  // namespace
}  // namespace beaconless
