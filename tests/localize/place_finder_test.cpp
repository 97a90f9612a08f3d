// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/place_finder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/people.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Verdict = PlaceFinder::Verdict;

/// A finder, and the building that its laser is truly in.
struct Search {
  explicit Search(const FloorPlan& map, const PlacesConfig& config = {}) : Search(map, map, config) {}
  Search(const FloorPlan& map, const FloorPlan& building, const PlacesConfig& config = {})
      : walls(building.segments()),
        finder(config, std::make_shared<const SurfaceMap>(WallIndex(map)), {}, {}) {
    finder.begin();
  }

  /// The verdict after a scan from a pose; a quarter of a second after the one before.
  Verdict see_from(const Pose2& pose, double people_share = 0.0) {
    RawScan raw = test::sweep(walls, pose, 0.01, rng);
    if (people_share > 0.0) raw = test::among_people(raw, people_share, rng);
    points = test::points_of(Scan::make(raw).value());
    const std::optional<Pose2> moved = last ? std::optional(last->inverse() * pose) : std::nullopt;
    last = pose;
    return finder.see(Stamp::from_seconds(0.25 * scans++), points, moved);
  }

  /// Drives straight to a place in steps of 0.1 m, heading as before.
  std::vector<Verdict> drive_to(const Eigen::Vector2d& goal) {
    std::vector<Verdict> verdicts;
    const Pose2 from = *last;
    const int steps = static_cast<int>((goal - from.translation()).norm() / 0.1);
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector2d at = from.translation() + i * (goal - from.translation()) / steps;
      verdicts.push_back(see_from({at.x(), at.y(), from.theta_rad}));
    }
    return verdicts;
  }

  bool is_among_likely(const Pose2& pose) const {
    const auto likely = finder.likely();
    return std::any_of(likely.begin(), likely.end(), [&](const PlaceFinder::Place& place) {
      return distance_m(place.map_from_laser, pose) < 0.1;
    });
  }

  void expect_sane() const {
    double weights = 0.0;
    for (const PlaceFinder::Place& place : finder.likely()) {
      weights += finder.weight(place);
      EXPECT_TRUE(place.map_from_laser.is_finite());
      EXPECT_TRUE(std::isfinite(place.total));
    }
    if (!finder.places().empty()) {
      EXPECT_NEAR(weights, 1.0, 1e-9);
    }
  }

  RayCaster walls;
  PlaceFinder finder;
  Rng rng{4};
  std::vector<Eigen::Vector2d> points;
  std::optional<Pose2> last;
  int scans = 0;
};

/// Two like rooms around a corner, the second 12 m beside the first: only at the far end, which is not seen
/// from the beginning, does a pillar tell them apart.
FloorPlan two_bent_rooms() {
  FloorPlan plan;
  for (const double x : {0.0, 12.0})
    plan.walls.push_back({{x, 0}, {x + 6, 0}, {x + 6, 9}, {x + 3, 9}, {x + 3, 3}, {x, 3}, {x, 0}});
  plan.walls.push_back({{15.5, 7.4}, {16.3, 7.4}, {16.3, 8.0}, {15.5, 8.0}, {15.5, 7.4}});
  return plan;
}
const Pose2 kFirstRoom{1.0, 1.5, 0.0};
const Pose2 kSecondRoom{13.0, 1.5, 0.0};

TEST(PlaceFinder, OfARoomWithoutSymmetryOneLookIsEnough) {
  for (const Pose2& pose : {Pose2{2.0, 1.5, 0.4}, Pose2{5.0, 4.0, -2.0}, Pose2{1.0, 4.2, 3.0}}) {
    Search search(test::niche_room());
    EXPECT_EQ(search.see_from(pose), Verdict::one) << pose;
    ASSERT_FALSE(search.finder.places().empty());
    EXPECT_LT(distance_m(search.finder.places().front().map_from_laser, pose), 0.02);
    search.expect_sane();
  }
}

TEST(PlaceFinder, OfARoomThatIsTheSameTurnedItNeverSaysWhichEnd) {
  FloorPlan plan = test::rectangle(8.0, 5.0);
  plan.walls.push_back({{2.0, 1.0}, {2.6, 1.0}, {2.6, 1.6}, {2.0, 1.0}});
  plan.walls.push_back({{6.0, 4.0}, {5.4, 4.0}, {5.4, 3.4}, {6.0, 4.0}});
  Search search(plan);
  const Pose2 pose{3.5, 3.0, 0.7};
  const auto check = [&] {
    EXPECT_TRUE(search.is_among_likely(*search.last));
    EXPECT_TRUE(search.is_among_likely({8.0 - search.last->x_m, 5.0 - search.last->y_m, 0.0}));
  };
  for (int i = 0; i < 30; ++i) ASSERT_EQ(search.see_from(pose, i % 3 == 0 ? 0.2 : 0.0), Verdict::several);
  check();
  for (const Eigen::Vector2d& goal : {Eigen::Vector2d(6.5, 2.5), {4.0, 1.0}, {1.0, 3.5}})
    for (const Verdict verdict : search.drive_to(goal)) ASSERT_EQ(verdict, Verdict::several);
  check();
  search.expect_sane();
}

TEST(PlaceFinder, ADriveAroundACornerTellsTwoRoomsApart) {
  for (const Pose2& start : {kFirstRoom, kSecondRoom}) {
    Search search(two_bent_rooms());
    EXPECT_EQ(search.see_from(start), Verdict::several);
    EXPECT_TRUE(search.is_among_likely(kFirstRoom) && search.is_among_likely(kSecondRoom));
    search.drive_to({start.x_m + 3.5, 1.5});
    const auto verdicts = search.drive_to({start.x_m + 3.5, 6.0});
    EXPECT_EQ(verdicts.back(), Verdict::one);
    EXPECT_LT(distance_m(search.finder.places().front().map_from_laser, *search.last), 0.05);
    search.expect_sane();
  }
}

TEST(PlaceFinder, APlaceThatComesUpLateIsJudgedByWhatWasSeenBefore) {
  // From a hall of its own into one of two like rooms, with one step that the wheels tell.
  FloorPlan plan;
  const auto add = [&plan](const FloorPlan& room, const Eigen::Vector2d& at) {
    for (FloorPlan::Polyline wall : room.walls) {
      for (Eigen::Vector2d& corner : wall) corner += at;
      plan.walls.push_back(wall);
    }
  };
  add(test::niche_room(), {0.0, 0.0});
  add(test::niche_room(), {12.0, 0.0});
  add(test::l_room(), {12.0, 10.0});
  const Pose2 there{14.0, 1.5, 0.4};
  Search late(plan);
  EXPECT_EQ(late.see_from(there), Verdict::several);
  Search search(plan);
  ASSERT_EQ(search.see_from({14.0, 12.0, 0.3}), Verdict::one);
  EXPECT_EQ(search.see_from(there), Verdict::one);
  EXPECT_TRUE(search.is_among_likely(there));
}

TEST(PlaceFinder, WhatWasToldOnceStaysToldWhereRoomsAreAlike) {
  Search search(two_bent_rooms());
  // From the far end, which tells, to where both rooms look the same.
  ASSERT_EQ(search.see_from({16.5, 6.0, 0.0}), Verdict::one);
  for (const Verdict verdict : search.drive_to({16.5, 1.5})) ASSERT_EQ(verdict, Verdict::one);
  for (const Verdict verdict : search.drive_to({13.5, 1.5})) ASSERT_EQ(verdict, Verdict::one);
  EXPECT_LT(distance_m(search.finder.places().front().map_from_laser, *search.last), 0.05);
}

TEST(PlaceFinder, ALongBareCorridorIsMoreThanOnePlace) {
  Search search(FloorPlan{{{{0, 0}, {200, 0}}, {{0, 2.5}, {200, 2.5}}}});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(search.see_from({100.0 + 0.2 * i, 1.2, 0.1}), Verdict::several);
}

TEST(PlaceFinder, AnOnlyPlaceThatIsNotHeldAlongItsWallIsNotOneEither) {
  Search search(FloorPlan{{{{0, 0}, {200, 0}}}});
  search.finder.begin({{99.9, 1.0}, {100.1, 1.4}});
  EXPECT_EQ(search.see_from({100.0, 1.2, 0.1}), Verdict::several);
  EXPECT_EQ(search.finder.likely().size(), 1U);
}

TEST(PlaceFinder, AScanOfAnotherBuildingFitsNowhere) {
  Search search(test::niche_room(), test::rack_hall());
  for (int i = 0; i < 6; ++i) EXPECT_EQ(search.see_from({1.2 + 0.3 * i, 1.0, 0.3}), Verdict::nothing) << i;
  search.expect_sane();
}

TEST(PlaceFinder, OfAPartOfTheMapOnlyThatIsSearched) {
  Search search(two_bent_rooms());
  search.finder.begin({{0.0, 0.0}, {6.0, 9.0}});
  EXPECT_EQ(search.see_from(kFirstRoom), Verdict::one);
  EXPECT_TRUE(search.is_among_likely(kFirstRoom));
  search.finder.begin({{12.0, 0.0}, {18.0, 9.0}});
  search.see_from(kFirstRoom);
  EXPECT_FALSE(search.is_among_likely(kFirstRoom));
}

TEST(PlaceFinder, TakesNothingFewBeamsAndACoveredLaser) {
  Search search(test::niche_room());
  const std::vector<Eigen::Vector2d> none;
  const std::vector<Eigen::Vector2d> few{{1.0, 0.0}, {0.0, 1.0}, {2.0, 2.0}};
  const std::vector<Eigen::Vector2d> covered(500, Eigen::Vector2d(0.12, 0.0));
  const std::vector<Eigen::Vector2d> at_the_laser(500, Eigen::Vector2d::Zero());
  int scan = 0;
  for (int round = 0; round < 3; ++round)
    for (const auto* points : {&none, &few, &covered, &at_the_laser, &none}) {
      const Verdict verdict =
          search.finder.see(Stamp::from_seconds(0.6 * scan++), *points, Pose2{0.5, 0.0, 0.1});
      EXPECT_NE(verdict, Verdict::one);
      search.expect_sane();
    }
  // It is found all the same when it sees again.
  search.finder.begin();
  EXPECT_EQ(search.see_from({2.0, 1.5, 0.4}), Verdict::one);
}

TEST(PlaceFinder, GivesTheSameBitsWithAnyNumberOfThreads) {
  std::vector<double> totals;
  for (const int threads : {1, 2, 3}) {
    Search search(two_bent_rooms(), PlacesConfig{.search = {.threads = threads}});
    search.see_from(kFirstRoom);
    search.drive_to({3.0, 1.5});
    double sum = 0.0;
    for (const PlaceFinder::Place& place : search.finder.places())
      sum += place.total + place.map_from_laser.x_m + place.map_from_laser.theta_rad;
    totals.push_back(sum);
  }
  EXPECT_EQ(totals[0], totals[1]);
  EXPECT_EQ(totals[0], totals[2]);
}

}  // namespace
}  // namespace beaconless
