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
  EXPECT_TRUE(shaken.take(kStart, false));
  EXPECT_FALSE(shaken.take(kStart, false));
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
  EXPECT_TRUE(shaken.take(kStart, false));
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

}  // namespace
}  // namespace beaconless
