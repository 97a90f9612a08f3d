// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/thin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless::report {
namespace {

struct Curve {
  std::vector<double> x;
  std::vector<double> y;
};

Curve noisy_curve(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  Curve curve;
  for (std::size_t i = 0; i < count; ++i) {
    curve.x.push_back(0.025 * static_cast<double>(i));
    curve.y.push_back(rng.normal());
  }
  return curve;
}

TEST(Thin, LeavesShortCurvesAlone) {
  const Curve curve = noisy_curve(400, 1);
  EXPECT_EQ(thin(curve.x, curve.y, 100).size(), 400U);
  EXPECT_TRUE(thin({}, {}, 100).empty());
  EXPECT_EQ(thin(std::vector{1.0}, std::vector{2.0}, 100).size(), 1U);
}

TEST(Thin, KeepsTheExtremesOfEachColumn) {
  constexpr std::size_t kColumns = 300;
  const Curve curve = noisy_curve(100'000, 2);
  const auto kept = thin(curve.x, curve.y, kColumns);
  EXPECT_LE(kept.size(), 4 * kColumns);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), curve.x.size() - 1);
  // The slow twin: lowest and highest of each column, from all points and from those that were kept.
  std::vector<double> low(kColumns, 1e9), high(kColumns, -1e9), kept_low = low, kept_high = high;
  const auto column = [&](std::size_t i) {
    return std::min(kColumns - 1, static_cast<std::size_t>(curve.x[i] / curve.x.back() * kColumns));
  };
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    low[column(i)] = std::min(low[column(i)], curve.y[i]);
    high[column(i)] = std::max(high[column(i)], curve.y[i]);
  }
  for (const std::size_t i : kept) {
    kept_low[column(i)] = std::min(kept_low[column(i)], curve.y[i]);
    kept_high[column(i)] = std::max(kept_high[column(i)], curve.y[i]);
  }
  EXPECT_EQ(low, kept_low);
  EXPECT_EQ(high, kept_high);
}

TEST(Thin, KeepsOneSpikeAmongAHundredThousand) {
  Curve curve = noisy_curve(100'000, 3);
  curve.y[54'321] = 1000.0;
  const auto kept = thin(curve.x, curve.y, 200);
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 54'321U));
}

TEST(Thin, KeepsGaps) {
  Curve curve = noisy_curve(100'000, 4);
  for (std::size_t i = 40'000; i < 60'000; ++i) curve.y[i] = std::numeric_limits<double>::quiet_NaN();
  const auto kept = thin(curve.x, curve.y, 100);
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](std::size_t i) { return std::isnan(curve.y[i]); }));
}

TEST(Thin, HoldsWhenAllPointsHaveOneX) {
  const std::vector<double> x(5000, 7.0);
  std::vector<double> y(5000, 1.0);
  y[1234] = -5.0;
  const auto kept = thin(x, y, 10);
  EXPECT_LE(kept.size(), 4U);
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 1234U));
}

}  // namespace
}  // namespace beaconless::report
