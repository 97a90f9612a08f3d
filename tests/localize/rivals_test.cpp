// SPDX-License-Identifier: Apache-2.0
// Places that fit about as well as the one taken: told by hand what fits how well where.
#include "beaconless/localize/rivals.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

constexpr Pose2 kTaken{2.0, 1.0, 0.1};
constexpr Pose2 kOther{3.0, 1.0, 0.1};
constexpr Pose2 kFurther{5.0, 1.0, 0.1};
constexpr Pose2 kMoved{0.05, 0.0, 0.02};
constexpr Pose2 kStood;
constexpr double kGood = 0.1;
constexpr double kFar = 0.6;

MatchResult fit_at(const Pose2& pose, double misfit, MatchStatus status = MatchStatus::converged) {
  MatchResult fit;
  fit.map_from_laser = pose;
  fit.misfit = misfit;
  fit.status = status;
  return fit;
}

/// Rivals after a scan that fits `places` and is taken to be at kTaken.
Rivals rivals_at(std::initializer_list<MatchResult> places) {
  Rivals rivals;
  for (const MatchResult& place : places) rivals.note(place);
  rivals.look(fit_at(kTaken, kGood));
  return rivals;
}

TEST(Rivals, AreFitsElsewhereThatAreAsGood) {
  EXPECT_TRUE(rivals_at({fit_at(kOther, kGood)}).any());
  EXPECT_TRUE(rivals_at({fit_at(kOther, 1.1 * kGood)}).any());
  EXPECT_TRUE(rivals_at({fit_at(kTaken * Pose2{0, 0, radians(10.0)}, kGood)}).any()) << "turned is elsewhere";
  EXPECT_FALSE(rivals_at({}).any());
  EXPECT_FALSE(rivals_at({fit_at(kOther, kFar)}).any()) << "it fits far worse";
  EXPECT_FALSE(rivals_at({fit_at(kOther, kGood, MatchStatus::too_few_pairs)}).any()) << "it is no fit";
  EXPECT_FALSE(rivals_at({fit_at(kTaken * Pose2{0.05, 0, radians(1.0)}, kGood)}).any())
      << "it is the same place";
}

TEST(Rivals, OnePlaceThatSeveralFitsFoundCountsOnce) {
  const Rivals once = rivals_at({fit_at(kOther, kGood)});
  const Rivals twice = rivals_at({fit_at(kOther, kGood), fit_at(kOther * kMoved, kGood)});
  EXPECT_EQ(twice.covariance(kTaken, {}), once.covariance(kTaken, {}));
}

TEST(Rivals, NotesThatAreForgottenAreNotLookedAt) {
  Rivals rivals;
  rivals.note(fit_at(kOther, kGood));
  rivals.forget_notes();
  rivals.look(fit_at(kTaken, kGood));
  EXPECT_FALSE(rivals.any());

  rivals.note(fit_at(kOther, kGood));
  MatchResult taken = fit_at(kTaken, kGood);
  rivals.follow(taken, kStood, [](const Pose2& place) { return fit_at(place, kGood); });
  rivals.look(taken);
  EXPECT_FALSE(rivals.any()) << "the next scan forgets those of the last";
}

TEST(Rivals, ANewLookForgetsThoseOfTheLast) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  rivals.forget_notes();
  rivals.look(fit_at(kTaken, kGood));
  EXPECT_FALSE(rivals.any());
}

TEST(Rivals, ClearedThereAreNone) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  rivals.clear();
  EXPECT_FALSE(rivals.any());
  rivals.look(fit_at(kTaken, kGood));
  EXPECT_FALSE(rivals.any()) << "nor notes of any";
}

TEST(Rivals, AreFollowedFromWhereTheyMoveToWithTheRobot) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  Pose2 guess;
  Pose2 expected = kOther;
  Pose2 taken_at = kTaken;
  for (int scan = 0; scan < 20; ++scan) {
    expected = expected * kMoved;
    taken_at = taken_at * kMoved;
    MatchResult taken = fit_at(taken_at, kGood);
    EXPECT_FALSE(rivals.follow(taken, kMoved, [&](const Pose2& place) {
      guess = place;
      return fit_at(place * Pose2{0.01, 0, 0}, kGood);
    }));
    EXPECT_LT(distance_m(guess, expected), 1e-9) << scan;
    EXPECT_LT(heading_difference_rad(guess, expected), 1e-9) << scan;
    expected = expected * Pose2{0.01, 0, 0};  // a fit is gone on from
    EXPECT_EQ(taken.map_from_laser, taken_at);
    ASSERT_TRUE(rivals.any());
  }
}

TEST(Rivals, OneThatComesToFitBetterIsTaken) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  MatchResult taken = fit_at(kTaken, kFar);
  EXPECT_TRUE(rivals.follow(taken, kStood, [](const Pose2& place) { return fit_at(place, kGood); }));
  EXPECT_EQ(taken.map_from_laser, kOther);
  EXPECT_EQ(taken.misfit, kGood);
  EXPECT_FALSE(rivals.any()) << "what was taken fits far worse, and what is taken is its own rival no more";
}

TEST(Rivals, TheBestOfSeveralIsTaken) {
  for (const bool is_first_best : {true, false}) {
    Rivals rivals = rivals_at({fit_at(kOther, kGood), fit_at(kFurther, kGood)});
    MatchResult taken = fit_at(kTaken, kFar);
    EXPECT_TRUE(rivals.follow(taken, kStood, [&](const Pose2& place) {
      return fit_at(place, (place == kOther) == is_first_best ? 0.01 : 0.3);
    }));
    EXPECT_EQ(taken.map_from_laser, is_first_best ? kOther : kFurther);
  }
}

TEST(Rivals, OneThatFitsWorseForEightScansInARowIsDropped) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  const auto see = [&](double misfit) {
    MatchResult taken = fit_at(kTaken, kGood);
    EXPECT_FALSE(rivals.follow(taken, kStood, [&](const Pose2& place) { return fit_at(place, misfit); }));
  };
  for (int scan = 0; scan < 7; ++scan) see(kFar);
  EXPECT_TRUE(rivals.any());
  see(kGood);  // and counting begins anew
  for (int scan = 0; scan < 7; ++scan) see(kFar);
  EXPECT_TRUE(rivals.any());
  see(kFar);
  EXPECT_FALSE(rivals.any());
}

TEST(Rivals, FitsThatFailCountAsWorse) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood)});
  for (int scan = 0; scan < 8; ++scan) {
    ASSERT_TRUE(rivals.any()) << scan;
    MatchResult taken = fit_at(kTaken, kGood);
    rivals.follow(taken, kStood,
                  [](const Pose2& place) { return fit_at(place, kGood, MatchStatus::too_few_pairs); });
  }
  EXPECT_FALSE(rivals.any());
}

TEST(Rivals, ThoseThatComeTogetherAreOne) {
  Rivals rivals = rivals_at({fit_at(kOther, kGood), fit_at(kFurther, kGood)});
  MatchResult taken = fit_at(kTaken, kGood);
  rivals.follow(taken, kStood, [](const Pose2&) { return fit_at(kOther, kGood); });
  EXPECT_EQ(rivals.covariance(kTaken, {}), rivals_at({fit_at(kOther, kGood)}).covariance(kTaken, {}));
}

TEST(Rivals, WidenTheCovarianceByTheWayToEachOfThem) {
  const Pose2 north = kTaken * Pose2{0.0, 2.0, radians(30.0)};
  const Rivals rivals = rivals_at({fit_at(kOther, kGood), fit_at(north, kGood)});
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (const Pose2& place : {kOther, north}) {
    const Eigen::Vector3d way(place.x_m - kTaken.x_m, place.y_m - kTaken.y_m,
                              place.theta_rad - kTaken.theta_rad);
    expected += way * way.transpose();
  }
  EXPECT_TRUE(rivals.covariance(kTaken, {}).isApprox(expected, 1e-12));
  EXPECT_TRUE(rivals_at({}).covariance(kTaken, {}).isZero());
}

TEST(Rivals, TheWayIsThatOfTheBaseAndTheShorterTurn) {
  const Pose2 laser_from_base{-0.5, 0.0, 0.0};
  const Pose2 turned{kTaken.x_m, kTaken.y_m, wrap_angle(kTaken.theta_rad + radians(170.0))};
  const Rivals rivals = rivals_at({fit_at(turned, kGood)});
  const Eigen::Matrix3d covariance = rivals.covariance(kTaken * laser_from_base, laser_from_base);
  // The base swings around the laser: a chord of a circle of half a metre.
  EXPECT_NEAR(std::sqrt(covariance(0, 0) + covariance(1, 1)), std::sin(radians(85.0)), 1e-9);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), radians(170.0), 1e-9);
  const Pose2 behind{kTaken.x_m, kTaken.y_m, kPi - 0.1};
  const Rivals across = rivals_at({fit_at(behind, kGood)});
  EXPECT_NEAR(std::sqrt(across.covariance({kTaken.x_m, kTaken.y_m, -kPi + 0.1}, {})(2, 2)), 0.2, 1e-9);
}

}  // namespace
}  // namespace beaconless
