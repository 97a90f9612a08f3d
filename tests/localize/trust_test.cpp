// SPDX-License-Identifier: Apache-2.0
// How far a pose deserves trust, by beams whose ends are known.
#include "beaconless/localize/trust.hpp"

#include <gtest/gtest.h>

#include "beaconless/map/floor_plan.hpp"

namespace beaconless {
namespace {

constexpr int kBeams = 120;  // all of a first scan are followed
constexpr double kTight_m = 0.02;

class TrustOfScans : public testing::Test {
 protected:
  /// A scan of a wall 2 m ahead, through which so many beams in a hundred and twenty pass.
  static std::vector<Eigen::Vector2d> scan(int through) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < kBeams; ++i) {
      // Spread over the scan, since of later ones a few beams are followed.
      const bool passes = (i * through) / kBeams != ((i + 1) * through) / kBeams;
      points.emplace_back(passes ? 3.0 : 2.0, 0.01 * (i - kBeams / 2));
    }
    return points;
  }
  static MatchResult fit(double blur, double on_map_ratio = 1.0) {
    MatchResult match;
    match.status = MatchStatus::converged;
    match.on_map_ratio = on_map_ratio;
    match.misfit = 1.0 - on_map_ratio + blur * on_map_ratio;
    return match;
  }
  void see(Trust& trust, int through, const MatchResult& match) const {
    trust.see(scan(through), map_, match, 0.0);
  }
  Trust after(int through, double blur, double on_map_ratio = 1.0) const {
    Trust trust;
    trust.begin();
    see(trust, through, fit(blur, on_map_ratio));
    return trust;
  }

 private:
  SurfaceMap map_ =
      build_surface_map(FloorPlan{{{{2.0, -5.0}, {2.0, 5.0}}, {{4.0, -5.0}, {4.0, 5.0}}}}, 0.6).value();
};

TEST_F(TrustOfScans, IsDeservedByAScanOnItsWallsAndNotByOneThroughThem) {
  EXPECT_GT(after(0, 0.01).quality(kTight_m), 0.5);
  EXPECT_LT(after(kBeams / 2, 0.01).quality(kTight_m), 0.01);
}

TEST_F(TrustOfScans, KnowsTheShareOfBeamsThatPassThroughWalls) {
  for (const int through : {0, 1, 12, 60, kBeams})
    EXPECT_DOUBLE_EQ(after(through, 0.0).through(), static_cast<double>(through) / kBeams);
}

TEST_F(TrustOfScans, FallsWithEveryBeamThatPassesThrough) {
  double before = 1.0;
  for (int through = 0; through <= 40; ++through) {
    const double quality = after(through, 0.05).quality(kTight_m);
    EXPECT_LT(quality, before) << through;
    EXPECT_GT(quality, 0.0);
    before = quality;
  }
}

TEST_F(TrustOfScans, FallsWithBlur) {
  double before = 1.0;
  for (double blur = 0.0; blur < 0.35; blur += 0.01) {
    const double quality = after(0, blur).quality(kTight_m);
    EXPECT_LT(quality, before) << blur;
    before = quality;
  }
}

TEST_F(TrustOfScans, WhatTheMapDoesNotExplainIsNoBlur) {
  const double all = after(0, 0.1).quality(kTight_m);
  for (const double on_map : {0.9, 0.5, 0.1}) EXPECT_NEAR(after(0, 0.1, on_map).quality(kTight_m), all, 1e-9);
}

TEST_F(TrustOfScans, OfNothingOnTheMapIsFinite) {
  const double quality = after(0, 0.0, 0.0).quality(kTight_m);
  EXPECT_TRUE(quality >= 0.0 && quality <= 1.0) << quality;
}

TEST_F(TrustOfScans, FallsWithTheLevelUntilItIsLoose) {
  const Trust trust = after(0, 0.05);
  double before = 1.0;
  for (const double level_m : {0.0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.6}) {
    EXPECT_LT(trust.quality(level_m), before) << level_m;
    before = trust.quality(level_m);
  }
  EXPECT_EQ(trust.quality(1000.0), before) << "unbounded is no worse than loose";
}

TEST_F(TrustOfScans, AnUntoldLevelIsNeitherTightNorLoose) {
  const Trust trust = after(0, 0.05);
  EXPECT_LT(trust.quality(std::nullopt), trust.quality(kTight_m));
  EXPECT_GT(trust.quality(std::nullopt), trust.quality(0.6));
}

TEST_F(TrustOfScans, OneBadScanOfManyIsNotTheEndAndFades) {
  Trust trust = after(0, 0.01);
  const double good = trust.quality(kTight_m);
  const double at_once = after(kBeams, 0.01).quality(kTight_m);
  see(trust, kBeams, fit(0.01));
  EXPECT_LT(trust.quality(kTight_m), good);
  EXPECT_GT(trust.quality(kTight_m), at_once);
  for (int i = 0; i < 100; ++i) see(trust, 0, fit(0.01));
  EXPECT_NEAR(trust.quality(kTight_m), good, 1e-3);
}

TEST_F(TrustOfScans, IsLookedAfterHoweverLongTheDrive) {
  Trust trust = after(0, 0.0);
  for (int i = 0; i < 1000; ++i) see(trust, 0, fit(0.0));
  for (int i = 0; i < 100; ++i) see(trust, kBeams, fit(0.0));
  EXPECT_NEAR(trust.through(), 1.0, 1e-3);
}

TEST_F(TrustOfScans, ABeginningForgets) {
  Trust trust = after(kBeams, 0.3);
  see(trust, kBeams, fit(0.3));
  trust.begin();
  see(trust, 3, fit(0.02));
  EXPECT_NEAR(trust.quality(kTight_m), after(3, 0.02).quality(kTight_m), 1e-12);
  EXPECT_NEAR(trust.through(), after(3, 0.02).through(), 1e-12);
}

}  // namespace
}  // namespace beaconless
