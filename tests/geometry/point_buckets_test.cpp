// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/point_buckets.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Indices = std::vector<std::size_t>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Indices found(const PointBuckets& buckets, const Eigen::Vector2d& place, double radius_m) {
  Indices indices;
  buckets.for_each_within(place, radius_m, [&](std::size_t i) { indices.push_back(i); });
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// The slow twin.
Indices compared_with_all(const Points& points, const Eigen::Vector2d& place, double radius_m) {
  Indices indices;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - place).squaredNorm() <= radius_m * radius_m) indices.push_back(i);
  return indices;
}

TEST(PointBuckets, FindWhatComparingWithAllFinds) {
  Rng rng(5);
  for (const double bucket_m : {0.01, 0.3, 2.0, 100.0}) {
    Points points;
    for (int i = 0; i < 500; ++i) points.emplace_back(rng.uniform(-7.0, 5.0), rng.uniform(20.0, 23.0));
    points.push_back(points.front());  // twice
    const PointBuckets buckets(points, bucket_m);
    EXPECT_EQ(buckets.size(), points.size());
    for (int query = 0; query < 300; ++query) {
      const Eigen::Vector2d place(rng.uniform(-10.0, 8.0), rng.uniform(18.0, 25.0));
      const double radius = rng.uniform(0.0, 3.0);
      EXPECT_EQ(found(buckets, place, radius), compared_with_all(points, place, radius));
    }
  }
}

TEST(PointBuckets, PointsOnBordersOfBucketsAreFoundFromBothSides) {
  Points points;
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y) points.emplace_back(x, y);
  const PointBuckets buckets(points, 1.0);
  for (const Eigen::Vector2d& place : points) {
    EXPECT_EQ(found(buckets, place, 1.0), compared_with_all(points, place, 1.0));
    EXPECT_EQ(found(buckets, place, 0.0).size(), 1U);
  }
}

TEST(PointBuckets, FarPointsNeedNoMoreBuckets) {
  // With buckets as asked this would be 1e36 of them.
  const Points points{{0.0, 0.0}, {1e15, 2e15}, {0.5, 0.0}, {-1e300, 1e300}, {1e308, -1e308}};
  const PointBuckets buckets(points, 1e-3);
  EXPECT_EQ(buckets.size(), points.size());
  EXPECT_EQ(found(buckets, {0.2, 0.0}, 0.4), (Indices{0, 2}));
  EXPECT_EQ(found(buckets, {1e15, 2e15}, 1.0), (Indices{1}));
}

TEST(PointBuckets, AllAtOnePlace) {
  const Points points(100, Eigen::Vector2d(3.0, -2.0));
  const PointBuckets buckets(points, 0.5);
  EXPECT_EQ(found(buckets, {3.0, -2.0}, 0.0).size(), 100U);
  EXPECT_TRUE(found(buckets, {3.1, -2.0}, 0.05).empty());
}

TEST(PointBuckets, WhatIsNotANumberIsNotFound) {
  const Points points{{kNan, 0.0}, {1.0, 1.0}, {0.0, kInfinity}};
  const PointBuckets buckets(points, 0.5);
  EXPECT_EQ(buckets.size(), 1U);
  EXPECT_EQ(found(buckets, {1.0, 1.0}, kInfinity), (Indices{1}));
  EXPECT_TRUE(found(buckets, {kNan, 1.0}, 1.0).empty());
  EXPECT_TRUE(found(buckets, {1.0, 1.0}, kNan).empty());
  EXPECT_TRUE(found(buckets, {1.0, 1.0}, -1.0).empty());
}

TEST(PointBuckets, OfNothingFindNothing) {
  EXPECT_TRUE(found(PointBuckets(), {0.0, 0.0}, 1.0).empty());
  EXPECT_TRUE(found(PointBuckets(Points{}, 1.0), {0.0, 0.0}, 1.0).empty());
  const PointBuckets odd(Points{{0.0, 0.0}, {1.0, 0.0}}, kNan);
  EXPECT_EQ(found(odd, {0.0, 0.0}, 0.5), (Indices{0}));
}

}  // namespace
}  // namespace beaconless
