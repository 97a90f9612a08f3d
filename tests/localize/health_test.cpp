// SPDX-License-Identifier: Apache-2.0
// When a fit is good, weak or lost, by how much of the scan lies on the map.
#include "beaconless/localize/health.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

constexpr double kFast_s = 0.025;  // between scans
constexpr double kSlow_s = 0.3;

/// Fits of one scan after the other.
struct Judged {
  explicit Judged(double step_s, const HealthConfig& config = {}) : health(config), step_s_(step_s) {}

  Status see(double on_map_ratio) {
    return health.judge(Stamp::from_seconds(step_s_ * scans_++), on_map_ratio);
  }
  Status see(double on_map_ratio, int times) {
    for (int i = 1; i < times; ++i) see(on_map_ratio);
    return see(on_map_ratio);
  }
  /// Weak fits until the robot is lost.
  int weak_until_lost(double on_map_ratio) {
    int weak = 0;
    while (!health.lost() && weak < 1000) {
      see(on_map_ratio);
      ++weak;
    }
    return weak;
  }

  Health health;

 private:
  double step_s_;
  int scans_ = 0;
};

TEST(Health, WithAFastScannerIsLostByTheCountOfWeakFits) {
  Judged run(kFast_s);
  ASSERT_EQ(run.see(0.9), Status::ok);
  EXPECT_EQ(run.see(0.5, 7), Status::degraded);
  EXPECT_FALSE(run.health.lost());
  EXPECT_EQ(run.see(0.5), Status::lost);
  EXPECT_TRUE(run.health.lost());
}

TEST(Health, WithASlowScannerIsLostByTheTimeOfThreeOrMore) {
  Judged run(kSlow_s);
  ASSERT_EQ(run.see(0.9), Status::ok);
  EXPECT_EQ(run.weak_until_lost(0.5), 3) << "0.6 s from the first to the third";
  Judged very_slow(10.0);
  very_slow.see(0.9);
  EXPECT_EQ(very_slow.weak_until_lost(0.5), 3) << "two weak fits never suffice";
}

TEST(Health, WeakFitsMustBeInARowToMeanLost) {
  for (const double step_s : {kFast_s, kSlow_s}) {
    Judged run(step_s);
    run.see(0.9);
    const int enough = Judged(run).weak_until_lost(0.5);
    for (int again = 0; again < 5; ++again) {
      EXPECT_EQ(run.see(0.5, enough - 1), Status::degraded);
      EXPECT_EQ(run.see(0.9), Status::ok);
    }
    EXPECT_FALSE(run.health.lost());
  }
}

TEST(Health, AFitThatExplainsNextToNothingIsCalledLostAtOnce) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(0.9);
  EXPECT_EQ(run.see(config.lost_ratio), Status::degraded);
  EXPECT_EQ(run.see(config.lost_ratio - 0.01), Status::lost);
  EXPECT_FALSE(run.health.lost()) << "one scan may be a hand before the scanner";
  EXPECT_EQ(run.see(0.9), Status::ok) << "so nothing has to be found again";
}

TEST(Health, IsFoundAgainByGoodFitsInARow) {
  Judged run(kFast_s);
  run.see(0.9);
  run.weak_until_lost(0.5);
  EXPECT_EQ(run.see(0.9, 4), Status::degraded);
  EXPECT_EQ(run.see(0.5), Status::lost) << "one that does not fit, and they are counted anew";
  EXPECT_EQ(run.see(0.9, 4), Status::degraded);
  EXPECT_TRUE(run.health.lost());
  EXPECT_EQ(run.see(0.9), Status::ok);
  EXPECT_FALSE(run.health.lost());
}

TEST(Health, APlaceThatTurnedOutWrongDoesNotCount) {
  Judged run(kFast_s);
  run.see(0.9);
  run.weak_until_lost(0.5);
  run.see(0.9, 4);
  run.health.forget_found();
  EXPECT_EQ(run.see(0.9, 4), Status::degraded);
  EXPECT_EQ(run.see(0.9), Status::ok);
}

TEST(Health, AtTheStartAFitMustConvinceByItself) {
  const HealthConfig config;
  Judged run(kFast_s);
  EXPECT_FALSE(run.health.at_home());
  EXPECT_TRUE(run.health.is_weak(config.found_ratio - 0.01));
  EXPECT_EQ(run.see(config.found_ratio), Status::ok);
  EXPECT_TRUE(run.health.at_home());
  EXPECT_FALSE(run.health.is_weak(config.found_ratio - 0.01)) << "here that is usual";
  EXPECT_TRUE(run.health.is_weak(config.weak_ratio - 0.01)) << "but this is weak anywhere";
}

TEST(Health, WhatIsUsualIsLearntFromTheFirstGoodFitAndFollowsGoodOnes) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(0.8);
  EXPECT_TRUE(run.health.is_weak(0.8 * config.weak_share - 0.01));
  EXPECT_FALSE(run.health.is_weak(0.8 * config.weak_share + 0.01));
  EXPECT_TRUE(run.health.is_doubtful(0.8 * config.doubt_share - 0.01));
  EXPECT_FALSE(run.health.is_doubtful(0.8 * config.doubt_share + 0.01));
  run.see(0.65, 500);  // not weak: people, or another part of the building
  EXPECT_TRUE(run.health.is_weak(0.65 * config.weak_share - 0.01));
  EXPECT_FALSE(run.health.is_weak(0.65 * config.weak_share + 0.01));
}

TEST(Health, OneGoodFitHardlyChangesWhatIsUsual) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(0.8);
  ASSERT_EQ(run.see(0.65), Status::ok);
  EXPECT_TRUE(run.health.is_weak(0.8 * config.weak_share - 0.01));
}

TEST(Health, HoweverLittleIsUsualSomeFitsAreWeak) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(0.5);
  run.see(0.4, 500);
  ASSERT_FALSE(run.health.lost());
  EXPECT_TRUE(run.health.is_weak(config.weak_ratio - 0.01));
  EXPECT_FALSE(run.health.is_weak(config.weak_ratio + 0.01));
}

TEST(Health, WeakFitsTeachNothingAboutWhatIsUsual) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(0.8);
  for (int again = 0; again < 100; ++again) {
    run.see(0.5, 7);
    run.see(0.8);
  }
  EXPECT_TRUE(run.health.is_weak(0.8 * config.weak_share - 0.01));
  EXPECT_FALSE(run.health.is_weak(0.8 * config.weak_share + 0.01));
}

TEST(Health, WhatWasUsualElsewhereDoesNotKeepARobotLostForEver) {
  Judged run(kFast_s);
  run.see(1.0);
  run.weak_until_lost(0.1);
  EXPECT_EQ(run.see(0.6), Status::lost) << "less than what was usual";
  int scans = 0;
  while (run.see(0.6) != Status::ok && scans < 1000) ++scans;
  EXPECT_LT(scans, 100);
  EXPECT_GT(scans, 5);
}

TEST(Health, OfALostRobotFitsThatAreWeakAnywhereTeachNothing) {
  const HealthConfig config;
  Judged run(kFast_s);
  run.see(1.0);
  run.weak_until_lost(0.1);
  run.see(config.weak_ratio - 0.01, 1000);
  EXPECT_TRUE(run.health.is_weak(config.doubt_share - 0.01));
}

}  // namespace
}  // namespace beaconless
