// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/line_fit.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// `count` points along a line, evenly from -half to half of its foot, with noise across.
Points on_line(const Line2& line, double half_m, int count, double sigma_m, Rng& rng) {
  const Eigen::Vector2d normal = line.normal();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  Points points;
  for (int i = 0; i < count; ++i) {
    const double t = -half_m + 2.0 * half_m * i / (count - 1);
    points.emplace_back((line.rho_m + rng.normal(sigma_m)) * normal + t * along);
  }
  return points;
}

Points moved(const Pose2& pose, const Points& points) {
  Points there;
  for (const Eigen::Vector2d& point : points) there.emplace_back(pose * point);
  return there;
}

/// How far two lines are apart within `reach_m` of `around`.
double apart_m(const Line2& p, const Line2& q, const Eigen::Vector2d& around, double reach_m) {
  const Eigen::Vector2d along(-std::sin(p.alpha_rad), std::cos(p.alpha_rad));
  const Eigen::Vector2d foot = around - p.signed_distance_m(around) * p.normal();
  return std::max(std::abs(q.signed_distance_m(foot + reach_m * along)),
                  std::abs(q.signed_distance_m(foot - reach_m * along)));
}

const std::vector<LineFitMethod> kAll = {LineFitMethod::regression, LineFitMethod::tls, LineFitMethod::ransac,
                                         LineFitMethod::theil_sen};

TEST(LineFit, EveryMethodFindsExactLinesInEveryDirection) {
  Rng rng(1);
  for (const LineFitMethod method : kAll)
    for (int degree = -180; degree < 180; degree += 5) {
      const Line2 line{radians(degree), 2.0};
      const auto fit = fit_line(on_line(line, 1.0, 20, 0.0, rng), {.method = method});
      ASSERT_TRUE(fit);
      ASSERT_LT(apart_m(fit->line, line, fit->centroid, 1.0), 1e-12)
          << static_cast<int>(method) << " " << degree;
      ASSERT_GE(fit->line.rho_m, 0.0);
      ASSERT_NEAR(fit->rms_m, 0.0, 1e-7);  // the root of what sums of squares round off
    }
}

TEST(LineFit, NothingWithoutADirection) {
  const Points same(5, Eigen::Vector2d(3.0, -2.0));
  for (const LineFitMethod method : kAll) {
    EXPECT_FALSE(fit_line(Points{}, {.method = method}));
    EXPECT_FALSE(fit_line(Points{{1.0, 2.0}}, {.method = method}));
    EXPECT_FALSE(fit_line(same, {.method = method}));
    const auto two = fit_line(Points{{1.0, 2.0}, {1.0, 3.0}}, {.method = method});
    ASSERT_TRUE(two);
    EXPECT_LT(apart_m(two->line, {0.0, 1.0}, {1.0, 2.5}, 1.0), 1e-12);
  }
}

TEST(LineFit, TlsIsTheLineOfTheSmallerEigenvector) {
  Rng rng(2);
  for (int run = 0; run < 200; ++run) {
    Points points;
    for (int i = 0; i < 12; ++i) points.emplace_back(rng.uniform(-5, 5), rng.uniform(-1, 8));
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& point : points) mean += point / 12.0;
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& point : points) spread += (point - mean) * (point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> slow(spread);
    const auto fit = fit_line_tls(points).value();
    EXPECT_NEAR(std::abs(fit.line.normal().dot(slow.eigenvectors().col(0))), 1.0, 1e-12);
    EXPECT_NEAR(fit.line.signed_distance_m(mean), 0.0, 1e-12);
    EXPECT_NEAR(fit.rms_m * fit.rms_m * 12.0, slow.eigenvalues()(0), 1e-10);
  }
}

TEST(LineFit, FromPrefixSumsAsFromThePointsOfTheInterval) {
  Rng rng(3);
  Points points;
  std::vector<PointMoments> prefix(1);
  for (int i = 0; i < 400; ++i) {
    points.emplace_back(20.0 + 0.01 * i, -9.0 + 0.02 * i + rng.normal(0.01));
    prefix.push_back(prefix.back());
    prefix.back().add(points.back().x(), points.back().y());
  }
  for (int run = 0; run < 100; ++run) {
    const auto first = static_cast<std::size_t>(rng.uniform(0, 390));
    const auto last =
        first + 3 + static_cast<std::size_t>(rng.uniform() * (396.0 - static_cast<double>(first)));
    const auto fast = fit_line_tls(prefix[last] - prefix[first]).value();
    const auto slow = fit_line_tls(std::span(points).subspan(first, last - first)).value();
    EXPECT_LT(apart_m(fast.line, slow.line, slow.centroid, 1.0), 1e-6);  // what point_moments.hpp promises
    EXPECT_NEAR(fast.rms_m, slow.rms_m, 1e-6);
    EXPECT_EQ(fast.count, slow.count);
  }
}

TEST(LineFit, AWeightOfThreeIsThePointThreeTimes) {
  Rng rng(4);
  const Points points = on_line({0.4, 3.0}, 2.0, 10, 0.05, rng);
  std::vector<double> weights(10, 1.0);
  weights[2] = 3.0;
  weights[7] = 0.0;
  Points repeated;
  for (std::size_t i = 0; i < 10; ++i)
    for (int k = 0; k < static_cast<int>(weights[i]); ++k) repeated.push_back(points[i]);
  const auto weighted = fit_line_tls(points, weights, 0.05).value();
  const auto plain = fit_line_tls(repeated, 0.05).value();
  EXPECT_LT(apart_m(weighted.line, plain.line, plain.centroid, 1.0), 1e-12);
  EXPECT_LT((weighted.covariance - plain.covariance).norm(), 1e-15);
}

// The formula, not the estimate from residuals, against 10000 draws: 10 % is T4's bound, 3 % would be three
// sigmas of the draws.
TEST(LineFit, CovarianceIsThatOfManyDraws) {
  Rng rng(5);
  const Line2 line{0.7, 4.0};
  for (const LineFitMethod method :
       {LineFitMethod::tls, LineFitMethod::regression, LineFitMethod::theil_sen}) {
    const bool is_slow = method == LineFitMethod::theil_sen;
    const int draws = is_slow ? 3000 : 10000;
    const int count = is_slow ? 40 : 30;
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    Eigen::Matrix2d told = Eigen::Matrix2d::Zero();
    for (int i = 0; i < draws; ++i) {
      Points points = on_line(line, 0.5, count, 0.01, rng);
      for (auto& point : points) point += 1.5 * Eigen::Vector2d(-std::sin(0.7), std::cos(0.7));
      const auto fit = fit_line(points, {.method = method, .sigma_m = 0.01}).value();
      const Eigen::Vector2d error(wrap_angle(fit.line.alpha_rad - line.alpha_rad),
                                  fit.line.rho_m - line.rho_m);
      sum += error * error.transpose() / draws;
      told += fit.covariance / draws;
    }
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(sum(k) / told(k), 1.0, 0.10) << static_cast<int>(method) << " " << k;
  }
}

TEST(LineFit, VarianceAtAPointIsThatOfTheLineThere) {
  Rng rng(6);
  const auto fit = fit_line_tls(on_line({0.3, 2.0}, 1.0, 21, 0.01, rng), 0.01).value();
  const double length = 2.0;
  const double T = 21.0 * 22.0 / 20.0 * length * length / 12.0;  // of 21 evenly spaced points
  const Eigen::Vector2d normal = fit.line.normal();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  for (const double s : {0.0, 0.5, 1.0, 3.0})
    EXPECT_NEAR(fit.variance_at(fit.centroid + s * along) / (1e-4 * (1.0 / 21.0 + s * s / T)), 1.0, 1e-3);
}

TEST(LineFit, MovesWithThePoints) {
  Rng rng(7);
  const Points points = on_line({1.1, 2.5}, 1.0, 25, 0.02, rng);
  for (const LineFitMethod method : {LineFitMethod::tls, LineFitMethod::ransac, LineFitMethod::theil_sen}) {
    const auto here = fit_line(points, {.method = method}).value();
    for (int run = 0; run < 50; ++run) {
      const Pose2 pose{rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-kPi, kPi)};
      const auto there = fit_line(moved(pose, points), {.method = method}).value();
      const Eigen::Vector2d a = pose * Eigen::Vector2d(here.line.rho_m * here.line.normal());
      const Eigen::Vector2d b = pose * Eigen::Vector2d(here.line.rho_m * here.line.normal() +
                                                       Eigen::Vector2d(-std::sin(here.line.alpha_rad),
                                                                       std::cos(here.line.alpha_rad)));
      EXPECT_NEAR(there.line.signed_distance_m(a), 0.0, 1e-9) << static_cast<int>(method);
      EXPECT_NEAR(there.line.signed_distance_m(b), 0.0, 1e-9) << static_cast<int>(method);
    }
  }
}

TEST(LineFit, RegressionTakesTheWiderAxis) {
  Rng rng(8);
  const auto upright = fit_line_regression(on_line({0.02, 2.0}, 1.0, 50, 0.01, rng)).value();
  EXPECT_LT(apart_m(upright.line, {0.02, 2.0}, {2.0, 0.0}, 1.0), 0.01);
  // The slope of the other axis, which Algorithm 3 inverts, would be off by far more.
  const auto flat = fit_line_regression(on_line({1.55, 2.0}, 1.0, 50, 0.01, rng)).value();
  EXPECT_LT(apart_m(flat.line, {1.55, 2.0}, {0.0, 2.0}, 1.0), 0.01);
}

TEST(LineFit, RansacWithoutOutliersIsTls) {
  Rng rng(9);
  for (int run = 0; run < 50; ++run) {
    const Points points = on_line({rng.uniform(-kPi, kPi), 2.0}, 1.0, 40, 0.005, rng);
    const auto ransac = fit_line_ransac(points, {.ransac_tolerance_m = 0.05}).value();
    EXPECT_LT(apart_m(ransac.line, fit_line_tls(points)->line, ransac.centroid, 1.0), 1e-12);
  }
}

TEST(LineFit, RansacBearsFortyPercentOutliers) {
  Rng rng(10);
  int good = 0;
  for (int run = 0; run < 1000; ++run) {
    const Line2 line{rng.uniform(-kPi, kPi), 1.0};
    Points points = on_line(line, 2.0, 60, 0.01, rng);
    for (int i = 0; i < 40; ++i) points.emplace_back(rng.uniform(-3, 3), rng.uniform(-3, 3));
    const auto fit = fit_line_ransac(points, {.ransac_min_base_m = 0.5, .ransac_seed = run});
    if (fit && apart_m(fit->line, line, fit->centroid, 2.0) < 0.03) ++good;
  }
  EXPECT_GE(good, 990);
}

TEST(LineFit, TheilSenBearsAQuarterOfOutliersOnOneSide) {
  Rng rng(11);
  for (int run = 0; run < 50; ++run) {
    const Line2 line{rng.uniform(-kPi, kPi), 1.0};
    Points points = on_line(line, 2.0, 60, 0.005, rng);
    for (std::size_t i = 0; i < 15; ++i) points[i * 4] += 0.5 * line.normal();
    const auto fit = fit_line(points, {.method = LineFitMethod::theil_sen}).value();
    EXPECT_LT(apart_m(fit.line, line, {0.0, 0.0}, 2.0), 0.02);
    EXPECT_GT(apart_m(fit_line_tls(points)->line, line, {0.0, 0.0}, 2.0), 0.05);
  }
}

TEST(LineFit, TheilSenThinsPairsEvenly) {
  Rng rng(12);
  const Points points = on_line({0.5, 3.0}, 2.0, 1000, 0.01, rng);
  const auto thinned =
      fit_line(points, {.method = LineFitMethod::theil_sen, .theil_sen_max_pairs = 5000}).value();
  EXPECT_LT(apart_m(thinned.line, {0.5, 3.0}, thinned.centroid, 2.0), 0.005);
}

}  // namespace
}  // namespace beaconless
