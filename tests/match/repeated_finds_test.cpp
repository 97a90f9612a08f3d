// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/repeated_finds.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// Views on a lattice in a hall without walls, and finds from them.
struct Hall {
  RayCaster walls{{{{-100, -100}, {100, -100}}}};
  std::vector<Pose2> views;
  std::vector<MapFind> finds;
  Rng rng{4};

  Hall() {
    for (int x = 0; x < 10; ++x)
      for (int y = 0; y < 10; ++y) views.push_back({1.0 * x, 1.0 * y, 0.0});
  }

  void find(std::size_t view, const Eigen::Vector2d& point, double orientation_rad = 0.0,
            double opening_rad = 0.0) {
    finds.push_back({{point, Eigen::Matrix2d::Identity(), orientation_rad, opening_rad},
                     static_cast<int>(view),
                     (point - views[view].translation()).norm()});
  }

  std::vector<RepeatedFind> gather(const RepeatedFindsConfig& config = {}) const {
    return gather_repeated_finds(finds, ViewsInSight(views, walls), config);
  }
};

TEST(RepeatedFinds, OfOneThingAreOneFeature) {
  Hall hall;
  for (std::size_t view = 0; view < hall.views.size(); ++view)
    hall.find(view, {4.3 + hall.rng.normal(0.01), 5.2 + hall.rng.normal(0.003)},
              wrap_angle(kPi + hall.rng.normal(0.05)), 1.5);
  const auto features = hall.gather();
  ASSERT_EQ(features.size(), 1U);
  const PointFeature& feature = features[0].feature;
  EXPECT_NEAR(feature.point.x(), 4.3, 4 * 0.01 / 10);  // four sigmas of the mean of a hundred
  EXPECT_NEAR(feature.point.y(), 5.2, 4 * 0.003 / 10);
  EXPECT_NEAR(feature.covariance(0, 0), 1e-4, 0.5e-4);
  EXPECT_NEAR(feature.covariance(1, 1), 9e-6, 5e-6);
  EXPECT_LT(std::abs(wrap_angle(feature.orientation_rad - kPi)), 0.02);  // around where angles wrap
  EXPECT_NEAR(feature.opening_rad, 1.5, 1e-9);
  EXPECT_EQ(features[0].evidence.found_views, 100);
  EXPECT_NEAR(features[0].evidence.share, 1.0, 0.02);
  EXPECT_NEAR(features[0].evidence.scatter_m, std::hypot(0.01, 0.003), 0.003);
}

TEST(RepeatedFinds, FarOutOnesDoNotPullTheMean) {
  Hall hall;
  for (std::size_t view = 0; view < 90; ++view) hall.find(view, {4.0 + hall.rng.normal(0.002), 4.0});
  for (std::size_t view = 90; view < 100; ++view) hall.find(view, {4.09, 4.0});
  const auto features = hall.gather();
  ASSERT_FALSE(features.empty());
  EXPECT_NEAR(features[0].feature.point.x(), 4.0, 0.002);
}

TEST(RepeatedFinds, TurnedOtherwiseAreAnotherFeature) {
  Hall hall;
  for (std::size_t view = 0; view < 100; ++view) {
    hall.find(view, {3.0, 3.0}, radians(45.0));
    hall.find(view, {3.0, 3.0}, radians(135.0));
  }
  EXPECT_EQ(hall.gather().size(), 2U);
  EXPECT_EQ(hall.gather({.same_turn_deg = 180.0}).size(), 1U);
}

TEST(RepeatedFinds, WhatMovesWithTheViewIsNone) {
  // The shadow of a post, along a wall.
  Hall hall;
  const Eigen::Vector2d post(5.3, -0.7);
  for (std::size_t view = 0; view < hall.views.size(); ++view) {
    const Eigen::Vector2d way = post - hall.views[view].translation();
    hall.find(view, post + way * (-3.0 - post.y()) / way.y());
  }
  EXPECT_TRUE(hall.gather().empty());
}

TEST(RepeatedFinds, WhatSlidesAlongAWallIsNone) {
  // Found by everybody, evenly over two metres.
  Hall hall;
  for (std::size_t view = 0; view < hall.views.size(); ++view)
    for (int k = 0; k < 5; ++k) hall.find(view, {hall.rng.uniform(0.0, 2.0), -1.0});
  EXPECT_TRUE(hall.gather().empty());
  EXPECT_FALSE(hall.gather({.max_scatter_m = 1.0}).empty());
}

TEST(RepeatedFinds, FoundTooSeldomIsNone) {
  Hall hall;
  for (const std::size_t view : {0U, 99U}) hall.find(view, {7.0, 2.0});
  EXPECT_TRUE(hall.gather().empty());
  EXPECT_EQ(hall.gather({.min_views = 2, .min_share = 0.0}).size(), 1U);
  // Five of a hundred views, all of which see it, from near and far.
  hall.finds.clear();
  for (const std::size_t view : {0U, 9U, 90U, 99U, 55U}) hall.find(view, {5.0, 5.0});
  EXPECT_TRUE(hall.gather().empty());
  // Twice in a view is not two views.
  hall.finds.clear();
  for (int i = 0; i < 10; ++i) hall.find(3, {0.0, 4.0});
  EXPECT_TRUE(hall.gather().empty());
}

TEST(RepeatedFinds, WhoCannotSeeItHasNoVote) {
  Hall hall;
  for (std::size_t view = 0; view < 8; ++view) hall.find(view, {-1.0, 4.5});
  EXPECT_TRUE(hall.gather({.min_share = 0.8}).empty());
  hall.walls = RayCaster({{{0.5, -50.0}, {0.5, 50.0}}});  // hides it from all but the first column of views
  ASSERT_EQ(hall.gather({.min_share = 0.8}).size(), 1U);
}

TEST(RepeatedFinds, FarViewsThatWouldNotFindItHaveNone) {
  // A small thing, found up to three metres away only.
  Hall hall;
  const Eigen::Vector2d thing(0.5, 0.5);
  for (std::size_t view = 0; view < hall.views.size(); ++view)
    if ((hall.views[view].translation() - thing).norm() < 3.0) hall.find(view, thing);
  const auto features = hall.gather({.min_share = 0.9});
  ASSERT_EQ(features.size(), 1U);
}

TEST(RepeatedFinds, ComeInOrderAndTheSameTwice) {
  Hall hall;
  for (int thing = 0; thing < 30; ++thing) {
    const Eigen::Vector2d at(hall.rng.uniform(0.0, 9.0), hall.rng.uniform(0.0, 9.0));
    for (std::size_t view = 0; view < 100; view += 2)
      hall.find(view, at + Eigen::Vector2d(hall.rng.normal(0.005), hall.rng.normal(0.005)));
  }
  const auto features = hall.gather();
  EXPECT_GE(features.size(), 25U);
  const auto again = hall.gather();
  ASSERT_EQ(again.size(), features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    EXPECT_EQ(features[i].feature.point, again[i].feature.point);
    if (i > 0) {
      EXPECT_TRUE(is_left_of(features[i - 1], features[i]));
    }
  }
}

TEST(RepeatedFinds, OfNothingAreNone) {
  const RayCaster walls({});
  EXPECT_TRUE(gather_repeated_finds({}, ViewsInSight({}, walls)).empty());
}

}  // namespace
}  // namespace beaconless
