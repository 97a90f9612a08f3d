// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless::eval {
namespace {

TEST(Statistics, OfKnownNumbers) {
  const Statistics s = statistics_of({4.0, 1.0, 3.0, 2.0, 10.0});
  EXPECT_DOUBLE_EQ(s.mean, 4.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(26.0));
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(10.0));
  EXPECT_DOUBLE_EQ(s.max, 10.0);
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.median, 3.0);
  EXPECT_DOUBLE_EQ(s.p95, 4.0 + 0.8 * 6.0);  // numpy.percentile([4, 1, 3, 2, 10], 95)
  EXPECT_EQ(s.count, 5U);
  EXPECT_DOUBLE_EQ(statistics_of({1.0, 2.0, 3.0, 5.0}).median, 2.5);
}

TEST(Statistics, OfOneAndOfNone) {
  const Statistics one = statistics_of({0.25});
  EXPECT_EQ(one, (Statistics{0.25, 0.25, 0.0, 0.25, 0.25, 0.25, 0.25, 1}));
  EXPECT_EQ(statistics_of({}), Statistics{});
}

TEST(Statistics, SquaresAddUpAlsoFarFromZero) {
  Rng rng(1);
  std::vector<double> values;
  double squares = 0.0;
  for (int i = 0; i < 1000; ++i) {
    values.push_back(1e6 + rng.normal(0.01));
    squares += values.back() * values.back() / 1000.0;
  }
  const Statistics s = statistics_of(values);
  EXPECT_NEAR(s.rmse * s.rmse, s.mean * s.mean + s.sd * s.sd, 1e-3);
  EXPECT_NEAR(s.rmse, std::sqrt(squares), 1e-8);
  EXPECT_NEAR(s.sd, 0.01, 4.0 * 0.01 / std::sqrt(2000.0)) << "not lost in the mean";
}

TEST(PoseError, HasSignsAndBothFrames) {
  // The robot looks along +y; the estimate lies 3 cm to the right and 4 cm ahead of it.
  const PosePair pair{Stamp{5}, {1.03, 2.04, radians(-178.0)}, {1.0, 2.0, radians(90.0)}};
  const auto errors = errors_of(std::vector{pair});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NEAR(errors[0].x_m, 0.03, 1e-12);
  EXPECT_NEAR(errors[0].y_m, 0.04, 1e-12);
  EXPECT_NEAR(errors[0].along_m, 0.04, 1e-12);
  EXPECT_NEAR(errors[0].across_m, -0.03, 1e-12);
  EXPECT_NEAR(errors[0].position_m(), 0.05, 1e-12);
  EXPECT_NEAR(errors[0].heading_rad, radians(92.0), 1e-12);
}

TEST(ErrorTable, HeadingIsAbsoluteAndWrapped) {
  std::vector<PosePair> pairs;
  for (const double off_deg : {-2.0, 2.0, -1.0, 1.0})
    pairs.push_back({{}, {0.0, 0.0, radians(179.5 + off_deg)}, {0.0, 0.0, radians(179.5)}});
  const ErrorTable table = table_of(errors_of(pairs));
  EXPECT_NEAR(table.heading_deg.mean, 1.5, 1e-9);
  EXPECT_NEAR(table.heading_deg.max, 2.0, 1e-9);
  EXPECT_EQ(table.position_m.max, 0.0);
}

}  // namespace
}  // namespace beaconless::eval
