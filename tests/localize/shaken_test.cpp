// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/shaken.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

const Stamp kStart{10'000'000'000};

TEST(Shaken, GoodFitsAreNoReasonForDoubt) {
  Shaken shaken;
  for (int i = 0; i < 10; ++i) {
    shaken.see_fit(Status::ok, false);
    EXPECT_TRUE(shaken.is_fitted());
    EXPECT_FALSE(shaken.take(kStart + 0.1 * i, false));
  }
}

TEST(Shaken, WhatShakesIsToldOnce) {
  Shaken shaken;
  shaken.see_jump();
  EXPECT_TRUE(shaken.take(kStart, false));
  EXPECT_FALSE(shaken.take(kStart, false));
  shaken.see_fit(Status::ok, true);
  EXPECT_TRUE(shaken.take(kStart + 5.0, false));
  EXPECT_FALSE(shaken.take(kStart + 5.0, false));
}

TEST(Shaken, OnlyTheFirstOfWeakFitsShakes) {
  Shaken shaken;
  shaken.see_fit(Status::degraded, false);
  EXPECT_FALSE(shaken.is_fitted());
  EXPECT_TRUE(shaken.take(kStart, false));
  shaken.see_fit(Status::degraded, false);
  EXPECT_FALSE(shaken.take(kStart, false));
  shaken.see_fit(Status::ok, false);
  shaken.see_fit(Status::lost, false);
  EXPECT_TRUE(shaken.take(kStart + 5.0, false));
}

TEST(Shaken, OneScanThatFitsNowhereSaysNothingAndTwoShake) {
  Shaken shaken;
  shaken.see_none(false);
  EXPECT_TRUE(shaken.is_blinded());
  shaken.see_fit(Status::ok, false);
  EXPECT_FALSE(shaken.is_blinded());
  EXPECT_FALSE(shaken.take(kStart, false));
  shaken.see_none(false);
  shaken.see_none(false);
  EXPECT_FALSE(shaken.is_blinded());
  EXPECT_FALSE(shaken.is_fitted());
  EXPECT_TRUE(shaken.take(kStart, false));
}

TEST(Shaken, BeamsThroughWallsShakeAfterTwoSecondsOfThem) {
  Shaken shaken;
  EXPECT_FALSE(shaken.take(kStart, true));
  EXPECT_FALSE(shaken.take(kStart + 1.9, true));
  EXPECT_FALSE(shaken.take(kStart + 1.95, false));
  EXPECT_FALSE(shaken.take(kStart + 2.1, true));
  EXPECT_FALSE(shaken.take(kStart + 4.0, true));
  EXPECT_TRUE(shaken.take(kStart + 4.2, true));
  EXPECT_FALSE(shaken.take(kStart + 4.3, true));
  EXPECT_TRUE(shaken.take(kStart + 6.3, true));
}

TEST(Shaken, ForgetsAll) {
  Shaken shaken;
  shaken.take(kStart, true);
  shaken.see_jump();
  shaken.see_none(false);
  shaken.forget();
  EXPECT_FALSE(shaken.is_blinded());
  EXPECT_FALSE(shaken.take(kStart + 3.0, true));
}

TEST(Shaken, ScansThatLieOnTheMapShakeNothingThoughTheMethodFindsTooLittle) {
  Shaken shaken;
  for (int i = 0; i < 10; ++i) {
    shaken.see_none(true);
    EXPECT_FALSE(shaken.is_blinded());
    EXPECT_FALSE(shaken.take(Stamp::from_seconds(0.1 * i), false)) << i;
  }
  shaken.see_none(false);
  EXPECT_TRUE(shaken.is_blinded());
  shaken.see_none(false);
  EXPECT_TRUE(shaken.take(Stamp::from_seconds(1.1), false));
}

TEST(Shaken, FitsThatTurnWeakAgainAndAgainShakeEverMoreRarely) {
  Shaken shaken;
  int doubts = 0;
  for (int i = 0; i < 40 * 60; ++i) {
    shaken.see_fit(i % 2 == 0 ? Status::ok : Status::degraded, false);
    doubts += shaken.take(Stamp::from_seconds(0.025 * i), false) ? 1 : 0;
  }
  EXPECT_GE(doubts, 4);
  EXPECT_LE(doubts, 7);  // 1, 2, 4 … s apart
}

TEST(Shaken, AJumpWaitsForASecondAtMost) {
  Shaken shaken;
  for (int i = 0; i < 40 * 20; ++i) {
    shaken.see_fit(i % 2 == 0 ? Status::ok : Status::degraded, false);
    shaken.take(Stamp::from_seconds(0.025 * i), false);
  }
  shaken.see_jump();
  bool is_told = false;
  for (int i = 0; i <= 40 && !is_told; ++i)
    is_told = shaken.take(Stamp::from_seconds(20.0 + 0.025 * i), false);
  EXPECT_TRUE(is_told);
}

TEST(Shaken, AfterAQuietMinuteADoubtIsTheFirstAgain) {
  Shaken shaken;
  for (int i = 0; i < 5; ++i) {
    shaken.see_fit(Status::ok, false);
    shaken.see_fit(Status::degraded, false);
    shaken.take(Stamp::from_seconds(4.0 * i), false);
  }
  shaken.see_fit(Status::ok, false);
  shaken.see_fit(Status::degraded, false);
  EXPECT_TRUE(shaken.take(Stamp::from_seconds(120.0), false));
  shaken.see_fit(Status::ok, false);
  shaken.see_fit(Status::degraded, false);
  EXPECT_TRUE(shaken.take(Stamp::from_seconds(121.5), false));
}

}  // namespace
}  // namespace beaconless
