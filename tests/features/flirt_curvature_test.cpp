// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_curvature.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// The definition by a graph: three minimum spanning trees one after the other, each of the complete graph
/// without the links of those before; shortest paths between all points; averages weighted by Gaussians of
/// the paths' lengths over the densities.
class Graph {
 public:
  explicit Graph(const FlirtContour& contour) {
    points_.reserve(contour.size());
    for (std::size_t i = 0; i < contour.size(); ++i) points_.emplace_back(contour.x_m[i], contour.y_m[i]);
    const std::size_t n = points_.size();
    links_.assign(n, {});
    linked_.assign(n * n, false);
    if (n > 1) linked_[n - 1] = linked_[(n - 1) * n] = true;  // flirtlib never links the ends
    for (int tree = 0; tree < 3; ++tree) add_tree();
    paths_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) paths_.push_back(paths_from(i));
  }

  double path_m(std::size_t i, std::size_t j) const { return paths_[i][j]; }

  std::vector<Eigen::Vector2d> moves(double sigma_m) const {
    const std::size_t n = points_.size();
    const auto weight = [&](std::size_t i, std::size_t j) {
      return std::exp(-paths_[i][j] * paths_[i][j] / (2.0 * sigma_m * sigma_m));
    };
    std::vector<double> density(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) density[i] += weight(i, j);
    std::vector<Eigen::Vector2d> moves(n);
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      double whole = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        sum += weight(i, j) / density[j] * points_[j];
        whole += weight(i, j) / density[j];
      }
      moves[i] = sum / whole - points_[i];
    }
    return moves;
  }

 private:
  struct Link {
    std::size_t to;
    double length_m;
  };

  /// Prim, without the links that are there.
  void add_tree() {
    const std::size_t n = points_.size();
    std::vector<double> nearest(n, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(n, n);
    std::vector<bool> inside(n, false);
    std::vector<Link> tree;
    nearest[0] = 0.0;
    for (std::size_t round = 0; round < n; ++round) {
      std::size_t next = n;
      for (std::size_t i = 0; i < n; ++i)
        if (!inside[i] && (next == n || nearest[i] < nearest[next])) next = i;
      inside[next] = true;
      for (std::size_t i = 0; i < n; ++i) {
        const double apart = (points_[i] - points_[next]).norm();
        if (inside[i] || linked_[next * n + i] || !(apart < nearest[i])) continue;
        nearest[i] = apart;
        from[i] = next;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (from[i] == n) continue;
      links_[i].push_back({from[i], nearest[i]});
      links_[from[i]].push_back({i, nearest[i]});
      linked_[i * n + from[i]] = linked_[from[i] * n + i] = true;
    }
  }

  /// Dijkstra.
  std::vector<double> paths_from(std::size_t start) const {
    using Step = std::pair<double, std::size_t>;
    std::vector<double> paths(points_.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    paths[start] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
      const auto [way, i] = open.top();
      open.pop();
      if (way > paths[i]) continue;
      for (const Link& link : links_[i])
        if (way + link.length_m < paths[link.to]) {
          paths[link.to] = way + link.length_m;
          open.emplace(paths[link.to], link.to);
        }
    }
    return paths;
  }

  std::vector<Eigen::Vector2d> points_;
  std::vector<std::vector<Link>> links_;
  std::vector<bool> linked_;
  std::vector<std::vector<double>> paths_;
};

FlirtContour contour_of(double sigma_m) {
  Rng rng(3);
  const RayCaster walls(test::rectangle(4, 3).segments());
  FlirtContour contour;
  gather_contour(Scan::make(test::sweep(walls, {2, 1.5, 0.3}, sigma_m, rng)).value(), 0.0, 0, contour);
  return contour;
}

struct Fast {
  CurvatureScratch scratch;
  std::vector<float> x, y;
};

Fast fast_moves(const FlirtContour& contour, double sigma_m) {
  Fast fast;
  measure_contour(contour, 10.0, fast.scratch);
  fast.x.resize(contour.size());
  fast.y.resize(contour.size());
  contour_moves(contour, contour.stretches[0], sigma_m,
                make_scale_kernel(FlirtKernel::sampled_gaussian, kCellsPerSigma), fast.scratch, fast.x,
                fast.y);
  return fast;
}

// Greatest difference of t = 2 |move| / sigma over the points that are 2 sigma from both ends.
double worst(const FlirtContour& contour, const std::vector<Eigen::Vector2d>& moves, const Fast& fast,
             double sigma_m) {
  double worst = 0.0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const double along_m = fast.scratch.along_m[i];
    if (along_m < 2.0 * sigma_m || fast.scratch.along_m.back() - along_m < 2.0 * sigma_m) continue;
    worst = std::max(worst, 2.0 / sigma_m * (moves[i] - Eigen::Vector2d(fast.x[i], fast.y[i])).norm());
  }
  return worst;
}

TEST(ContourMoves, AgreeWithTheGraphOnOneContour) {
  const FlirtContour contour = contour_of(0.0);
  ASSERT_EQ(contour.stretches.size(), 1U);
  const Graph graph(contour);
  for (const double sigma_m : {0.2, 0.28, 0.392}) {
    // The kernel is cut at 3 sigma (0.3 % of its weight, at an arm of 3 sigma: 0.02), cells widen it by 0.6
    // %, and some links cut a room's corner by a point or two.
    EXPECT_LT(worst(contour, graph.moves(sigma_m), fast_moves(contour, sigma_m), sigma_m), 0.06) << sigma_m;
  }
}

TEST(ContourMoves, AreThoseOfTheGraphUpToNoise) {
  // With 10 mm of noise on points 5 mm apart paths of graph and contour differ by some per cent of sigma; t
  // exp(-t) of a corner is above 0.34 for t from 0.7 to 1.4.
  const FlirtContour contour = contour_of(0.01);
  const Graph graph(contour);
  for (const double sigma_m : {0.2, 0.392})
    EXPECT_LT(worst(contour, graph.moves(sigma_m), fast_moves(contour, sigma_m), sigma_m), 0.25) << sigma_m;
}

TEST(ContourMoves, OfARightAngleAreThoseOfTheFormula) {
  // Each arm's mean distance under half a Gaussian is sigma sqrt(2 / pi) / 2 along it.
  const FlirtContour contour = contour_of(0.0);
  const double sigma_m = 0.2;
  const Fast fast = fast_moves(contour, sigma_m);
  double greatest = 0.0;
  for (std::size_t i = 300; i < 780; ++i)
    greatest = std::max(greatest, std::hypot(static_cast<double>(fast.x[i]), static_cast<double>(fast.y[i])));
  EXPECT_NEAR(2.0 / sigma_m * greatest, 2.0 * std::sqrt(2.0) * std::sqrt(2.0 / kPi) / 2.0, 0.03);
}

TEST(MeasureContour, IsNotMisledByNoise) {
  FlirtContour straight;
  Rng rng(2);
  for (int i = 0; i < 600; ++i) {
    straight.beam.push_back(static_cast<std::uint32_t>(i));
    straight.range_m.push_back(1.0F);
    straight.x_m.push_back(0.005F * static_cast<float>(i));
    straight.y_m.push_back(static_cast<float>(rng.normal(0.005)));
  }
  straight.stretches.push_back({0, 600, 0, 600, false});
  CurvatureScratch scratch;
  measure_contour(straight, 10.0, scratch);
  double zigzag_m = 0.0;
  for (std::size_t i = 1; i < 600; ++i)
    zigzag_m += std::hypot(straight.x_m[i] - straight.x_m[i - 1], straight.y_m[i] - straight.y_m[i - 1]);
  EXPECT_GT(zigzag_m, 4.0);  // of a wall of 3 m
  EXPECT_LT(scratch.along_m.back(), 3.4);
  EXPECT_GE(scratch.along_m.back(), 2.99);
}

TEST(MeasureContour, ALongLinkCountsForTheLimit) {
  FlirtContour contour;
  for (const float x : {0.0F, 1.0F, 80.0F, 81.0F}) {
    contour.beam.push_back(static_cast<std::uint32_t>(contour.beam.size()));
    contour.range_m.push_back(x + 1.0F);
    contour.x_m.push_back(x);
    contour.y_m.push_back(0.0F);
  }
  contour.stretches.push_back({0, 4, 0, 4, false});
  CurvatureScratch scratch;
  measure_contour(contour, 3.0, scratch);
  EXPECT_EQ(scratch.along_m, (std::vector<float>{0.0F, 1.0F, 4.0F, 5.0F}));
}

}  // namespace
}  // namespace beaconless
