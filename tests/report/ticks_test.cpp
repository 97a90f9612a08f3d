// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/ticks.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/core/rng.hpp"

namespace beaconless::report {
namespace {

/// Whether a value is 1, 2 or 5 times a power of ten.
bool is_round(double value) {
  const double mantissa = value / std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double digit : {1.0, 2.0, 5.0})
    if (std::abs(mantissa - digit) < 1e-6) return true;
  return false;
}

TEST(LinearAxis, HasRoundMarksForAnyRange) {
  Rng rng(1);
  for (int run = 0; run < 2000; ++run) {
    const double size = std::pow(10.0, rng.uniform(-7.0, 7.0));
    const double low = size * rng.uniform(-3.0, 3.0);
    const double high = low + size;
    for (const bool snug : {false, true}) {
      const Axis axis = linear_axis(low, high, 6, snug);
      ASSERT_GE(axis.ticks.size(), 3U);
      ASSERT_LE(axis.ticks.size(), 12U);
      const double step = axis.ticks[1].at - axis.ticks[0].at;
      EXPECT_TRUE(is_round(step)) << step;
      std::set<std::string> labels;
      for (const Tick& tick : axis.ticks) {
        EXPECT_NEAR(tick.at / step, std::round(tick.at / step), 1e-6);
        EXPECT_NEAR(*parse_double(tick.label), tick.at, 1e-6 * std::max(std::abs(tick.at), step));
        labels.insert(tick.label);
        EXPECT_GE(axis.fraction(tick.at), -0.01);
        EXPECT_LE(axis.fraction(tick.at), 1.01);
      }
      EXPECT_EQ(labels.size(), axis.ticks.size());  // no two marks read the same
      if (!snug) {
        EXPECT_LE(axis.low, low + 0.02 * step);
        EXPECT_GE(axis.high, high - 0.02 * step);
      }
    }
  }
}

TEST(LinearAxis, MultiplesOfATenthAreExact) {
  const Axis axis = linear_axis(0.0, 0.5, 5);
  ASSERT_EQ(axis.ticks.size(), 6U);
  EXPECT_EQ(axis.ticks[3], (Tick{0.3, "0.3"}));
  EXPECT_EQ(axis.ticks[0].label, "0");
}

TEST(LinearAxis, HoldsWhateverTheEndsAre) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double kNan = std::nan("");
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0.0, 0.0},
                                                                        {5.0, 5.0},
                                                                        {-1e9, -1e9},
                                                                        {2.0, 1.0},
                                                                        {kNan, kNan},
                                                                        {kNan, 3.0},
                                                                        {kInf, -kInf},
                                                                        {-1e300, 1e300},
                                                                        {1.0, 1.0 + 1e-15},
                                                                        {1e-320, 2e-320},
                                                                        {0.0, 1e-13}}) {
    const Axis axis = linear_axis(low, high);
    EXPECT_LT(axis.low, axis.high) << low << " " << high;
    EXPECT_GE(axis.ticks.size(), 2U) << low << " " << high;
    EXPECT_LE(axis.ticks.size(), 14U) << low << " " << high;
    EXPECT_TRUE(std::isfinite(axis.low) && std::isfinite(axis.high));
  }
}

TEST(LogAxis, HasDecades) {
  const Axis axis = log_axis(0.003, 42.0);
  EXPECT_DOUBLE_EQ(axis.low, 0.001);
  EXPECT_DOUBLE_EQ(axis.high, 100.0);
  EXPECT_EQ(axis.ticks.size(), 6U);
  EXPECT_DOUBLE_EQ(axis.fraction(0.1), 0.4);
  EXPECT_EQ(axis.fraction(0.0), 0.0);
  EXPECT_EQ(axis.fraction(-7.0), 0.0);
}

TEST(LogAxis, HoldsWhateverTheEndsAre) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {0.0, 0.0}, {-1.0, -2.0}, {1.0, 1.0}, {1e-300, 1e300}, {std::nan(""), 5.0}, {3.0, std::nan("")}}) {
    const Axis axis = log_axis(low, high);
    EXPECT_GT(axis.low, 0.0);
    EXPECT_LT(axis.low, axis.high);
    EXPECT_GE(axis.ticks.size(), 2U);
    EXPECT_LE(axis.ticks.size(), 12U);
  }
}

TEST(RoundBelow, IsTheNextRoundNumberDown) {
  EXPECT_DOUBLE_EQ(round_below(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_below(5.0), 5.0);
  EXPECT_DOUBLE_EQ(round_below(0.19), 0.1);
  EXPECT_DOUBLE_EQ(round_below(1000.0), 1000.0);
  EXPECT_DOUBLE_EQ(round_below(-1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_below(std::nan("")), 1.0);
}

}  // namespace
}  // namespace beaconless::report
