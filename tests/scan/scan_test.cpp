// SPDX-License-Identifier: Apache-2.0
// The gate: every habit of sensors and files that Scan::make settles, one test each.
#include "beaconless/scan/scan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A sweep as drivers give it; no two ranges are the same.
RawScan sweep(std::size_t count, double step_deg, double first_deg = -135.0) {
  RawScan raw;
  raw.stamp = Stamp{1'000'000'000'000};
  raw.frame_id = "laser";
  raw.angle_min_rad = static_cast<float>(radians(first_deg));
  raw.angle_increment_rad = static_cast<float>(radians(step_deg));
  raw.time_increment_s = 1.0F / 65536.0F;  // exact in binary: sums of it can be compared with ==
  raw.scan_time_s = 0.025F;
  raw.range_min_m = 0.1F;
  raw.range_max_m = 30.0F;
  for (std::size_t i = 0; i < count; ++i) raw.ranges_m.push_back(1.0F + 0.001F * static_cast<float>(i + 1));
  return raw;
}

RawScan with_ranges(std::vector<float> ranges_m) {
  RawScan raw = sweep(0, 1.0, 0.0);
  raw.ranges_m = std::move(ranges_m);
  return raw;
}

Scan made(const RawScan& raw, const ScanGate& gate = {}) { return Scan::make(raw, gate).value(); }

/// The same room seen by the same scanner mounted upside down: beams run the other way round.
RawScan upside_down(RawScan raw) {
  raw.angle_min_rad = -raw.angle_min_rad;
  raw.angle_increment_rad = -raw.angle_increment_rad;
  return raw;
}

TEST(Scan, PassesAGoodSweepThrough) {
  RawScan raw = sweep(1081, 0.25);
  raw.intensities.assign(1081, 7.0F);
  const Scan scan = made(raw);
  EXPECT_EQ(scan.stamp(), raw.stamp);
  EXPECT_EQ(scan.frame_id(), "laser");
  ASSERT_EQ(scan.size(), 1081U);
  EXPECT_EQ(scan.hit_count(), 1081U);
  EXPECT_EQ(scan.angle_min_rad(), static_cast<double>(raw.angle_min_rad));
  EXPECT_EQ(scan.angle_increment_rad(), static_cast<double>(raw.angle_increment_rad));
  EXPECT_EQ(scan.scan_time_s(), static_cast<double>(0.025F));
  EXPECT_THAT(scan.ranges_m(), testing::ElementsAreArray(raw.ranges_m));
  EXPECT_THAT(scan.intensities(), testing::ElementsAreArray(raw.intensities));
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_TRUE(scan.is_hit(i));
    ASSERT_EQ(scan.beam_time_s(i), static_cast<double>(i) / 65536.0);
    ASSERT_NEAR(scan.point(i).norm(), static_cast<double>(raw.ranges_m[i]), 3e-7)
        << "two floats of half an ulp";
    ASSERT_NEAR(std::atan2(scan.y_m()[i], scan.x_m()[i]), wrap_angle(scan.angle_rad(i)), 3e-7);
  }
}

TEST(Scan, AClockwiseSweepIsTheMirroredSweep) {
  for (const RawScan& raw : {sweep(1081, 0.25), sweep(360, 1.0, 0.0), sweep(361, 1.0, -180.0),
                             sweep(7, 60.0, 10.0), sweep(500, 1.0, 0.0), sweep(1, 1.0)}) {
    const Scan scan = made(raw);
    const Scan mirrored = made(upside_down(raw));
    ASSERT_EQ(mirrored.size(), scan.size());
    EXPECT_EQ(mirrored.stamp(), scan.stamp()) << "the first beam in time is the same beam";
    EXPECT_GT(mirrored.angle_increment_rad(), 0.0);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const std::size_t j = scan.size() - 1 - i;
      ASSERT_EQ(mirrored.ranges_m()[j], scan.ranges_m()[i]) << i;
      ASSERT_NEAR(mirrored.angle_rad(j), -scan.angle_rad(i), 1e-14) << i;
      ASSERT_EQ(mirrored.beam_time_s(j), scan.beam_time_s(i)) << "a beam is measured when it is measured";
      ASSERT_NEAR(mirrored.y_m()[j], -scan.y_m()[i], 3e-7) << i;
    }
  }
}

TEST(Scan, IntensitiesTurnWithTheirRanges) {
  RawScan raw = upside_down(sweep(361, 1.0, -180.0));
  for (std::size_t i = 0; i < 361; ++i) raw.intensities.push_back(static_cast<float>(i));
  const Scan scan = made(raw);
  ASSERT_EQ(scan.intensities().size(), 360U);
  EXPECT_EQ(scan.intensities().front(), 359.0F);
  EXPECT_EQ(scan.intensities().back(), 0.0F);
}

TEST(Scan, DropsTheDoubledBeamOfAFullTurn) {
  struct Case {
    std::size_t beams;
    double step_deg;
    std::size_t kept;
  };
  for (const auto& [beams, step_deg, kept] :
       {Case{360, 1.0, 360}, Case{361, 1.0, 360}, Case{1440, 0.25, 1440}, Case{1441, 0.25, 1440},
        Case{720, 0.5, 720}, Case{721, 0.5, 720}, Case{1081, 0.25, 1081}, Case{1153, 0.3125, 1152}}) {
    const RawScan raw = sweep(beams, step_deg, -180.0);
    const Scan scan = made(raw);
    EXPECT_EQ(scan.size(), kept) << beams << " beams by " << step_deg;
    EXPECT_EQ(scan.ranges_m().back(), raw.ranges_m[kept - 1]) << "the last in time goes";
    EXPECT_EQ(scan.is_full_circle(), kept != 1081) << beams << " beams by " << step_deg;
  }
}

TEST(Scan, CutsAnOverFullTurnToOneTurn) {
  Rng rng(1);
  for (int round = 0; round < 200; ++round) {
    const double step_deg = rng.uniform(0.1, 180.0);
    const Scan scan = made(sweep(4000, step_deg, rng.uniform(-180.0, 180.0)));
    const double first_to_last_rad = scan.angle_rad(scan.size() - 1) - scan.angle_min_rad();
    // The float's step may be 6e-8 of itself larger than meant.
    EXPECT_LE(first_to_last_rad, 2.0 * kPi - 0.5 * radians(step_deg) + 1e-6) << step_deg;
    EXPECT_GT(first_to_last_rad, 2.0 * kPi - 1.5 * radians(step_deg) - 1e-6) << "and not to less";
  }
}

TEST(Scan, JudgesEveryKindOfRange) {
  const Scan scan = made(with_ranges({5.0F, kNan, kInf, -kInf, 0.0F, -0.0F, -1.0F, 0.05F, 0.1F, 29.99F, 30.0F,
                                      31.0F, 65.533F, 3e38F, -3e38F, 1e-45F}));
  using enum Beam;
  EXPECT_THAT(scan.beams(),
              ElementsAre(hit, invalid, no_return, too_close, invalid, invalid, invalid, too_close, hit, hit,
                          no_return, no_return, no_return, no_return, invalid, too_close));
  EXPECT_EQ(scan.hit_count(), 3U);
}

TEST(Scan, WhatIsNoHitHasNoCoordinates) {
  const Scan scan = made(with_ranges({kNan, kInf, -kInf, 0.0F, 0.05F, 31.0F}));
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_EQ(scan.ranges_m()[i], 0.0F) << i;
    EXPECT_EQ(scan.x_m()[i], 0.0F) << i;
    EXPECT_EQ(scan.y_m()[i], 0.0F) << i;
  }
}

TEST(Scan, WithoutALimitNoRangeBecomesInfiniteWhenSquared) {
  RawScan raw = with_ranges({50.0F, 9e4F, 2e5F, 1e20F, 3e38F, kInf});
  for (const float told : {0.0F, -1.0F, kNan, kInf}) {
    raw.range_max_m = told;
    const Scan scan = made(raw);
    EXPECT_EQ(scan.range_max_m(), std::numeric_limits<double>::infinity()) << told;
    EXPECT_EQ(scan.hit_count(), 2U) << told;
    for (std::size_t i = 0; i < scan.size(); ++i)
      EXPECT_TRUE(std::isfinite(scan.x_m()[i] * scan.x_m()[i] + scan.y_m()[i] * scan.y_m()[i]));
  }
}

TEST(Scan, LimitsAreTheNarrowerOfSensorAndGate) {
  const RawScan raw = with_ranges({0.2F, 0.5F, 5.0F, 20.0F});  // the sensor's own: 0.1 … 30 m
  const Scan narrowed = made(raw, {.range_min_m = 0.4F, .range_max_m = 10.0F});
  using enum Beam;
  EXPECT_THAT(narrowed.beams(), ElementsAre(too_close, hit, hit, no_return));
  EXPECT_EQ(narrowed.range_min_m(), static_cast<double>(0.4F));
  EXPECT_EQ(narrowed.range_max_m(), static_cast<double>(10.0F));
  const Scan widened = made(raw, {.range_min_m = 0.01F, .range_max_m = 100.0F});
  EXPECT_EQ(widened.range_min_m(), static_cast<double>(0.1F));
  EXPECT_EQ(widened.range_max_m(), static_cast<double>(30.0F));
  RawScan silent = raw;
  silent.range_min_m = kNan;
  silent.range_max_m = 0.0F;
  EXPECT_THAT(made(silent, {.range_max_m = 10.0F}).beams(), ElementsAre(hit, hit, hit, no_return));
}

TEST(Scan, StampIsBroughtToTheFirstBeam) {
  const RawScan raw = sweep(1025, 0.25);  // 1024 steps of 1/65536 s: 15.625 ms
  EXPECT_EQ(made(raw, {.stamp_is = StampIs::first_beam}).stamp().ns, raw.stamp.ns);
  EXPECT_EQ(made(raw, {.stamp_is = StampIs::last_beam}).stamp().ns, raw.stamp.ns - 15'625'000);
  EXPECT_EQ(made(raw, {.stamp_is = StampIs::middle_beam}).stamp().ns, raw.stamp.ns - 7'812'500);
  EXPECT_EQ(made(upside_down(raw), {.stamp_is = StampIs::last_beam}).stamp().ns, raw.stamp.ns - 15'625'000);

  const RawScan doubled = sweep(361, 1.0, 0.0);  // its last beam in time is the one that is dropped
  EXPECT_EQ(made(doubled, {.stamp_is = StampIs::last_beam}).stamp(), raw.stamp + -360.0 / 65536.0);
}

TEST(Scan, ATimePerBeamThatCannotBeMeansNone) {
  for (const float told : {0.0F, -1e-5F, kNan, kInf, -kInf, 1.0F, 3e38F}) {
    RawScan raw = sweep(1081, 0.25);
    raw.time_increment_s = told;
    raw.scan_time_s = told;
    const Scan scan = made(raw, {.stamp_is = StampIs::last_beam});
    EXPECT_EQ(scan.stamp(), raw.stamp) << told;
    EXPECT_EQ(scan.beam_time_s(1080), 0.0) << told;
    EXPECT_TRUE(std::isfinite(scan.scan_time_s()) && scan.scan_time_s() >= 0.0) << told;
  }
}

TEST(Scan, AToldSweepTimeCountsMoreThanTheSources) {
  const RawScan raw = sweep(1025, 0.25);  // tells 15.625 ms
  const auto sweep_ms = [&raw](double told_s) {
    return 1e3 * made(raw, {.sweep_time_s = told_s}).sweep_time_s();
  };
  EXPECT_DOUBLE_EQ(sweep_ms(0.125), 125.0);
  EXPECT_DOUBLE_EQ(sweep_ms(0.001), 1.0);
  EXPECT_DOUBLE_EQ(sweep_ms(0.0), 15.625) << "not told";

  RawScan silent = raw;
  silent.time_increment_s = 0.0F;
  const Scan scan = made(silent, {.sweep_time_s = 0.5});
  EXPECT_DOUBLE_EQ(scan.sweep_time_s(), 0.5);
  EXPECT_DOUBLE_EQ(scan.beam_time_s(0), 0.0);
  EXPECT_DOUBLE_EQ(scan.beam_time_s(512), 0.25);
  EXPECT_DOUBLE_EQ(scan.beam_time_s(1024), 0.5);
  EXPECT_EQ(made(silent, {.sweep_time_s = 0.0}).sweep_time_s(), 0.0);
}

TEST(Scan, AToldSweepTimeShiftsTheStampAndTurnsWithTheBeams) {
  const RawScan raw = sweep(1025, 0.25);
  for (const RawScan& way : {raw, upside_down(raw)}) {
    const auto early_ns = [&](StampIs stamp_is) {
      return raw.stamp.ns - made(way, {.stamp_is = stamp_is, .sweep_time_s = 0.125}).stamp().ns;
    };
    EXPECT_EQ(early_ns(StampIs::first_beam), 0);
    EXPECT_EQ(early_ns(StampIs::middle_beam), 62'500'000);
    EXPECT_EQ(early_ns(StampIs::last_beam), 125'000'000);
  }
  EXPECT_DOUBLE_EQ(made(upside_down(raw), {.sweep_time_s = 0.125}).beam_time_s(0), 0.125);
}

TEST(Scan, AToldSweepTimeThatCannotBeCountsAsNotTold) {
  const RawScan raw = sweep(1025, 0.25);
  RawScan silent = raw;
  silent.time_increment_s = 0.0F;
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const auto inf = std::numeric_limits<double>::infinity();
  for (const double told_s : {nan, inf, -inf, -0.1, -0.0, 61.0, 1e300}) {
    EXPECT_DOUBLE_EQ(made(raw, {.sweep_time_s = told_s}).sweep_time_s(), 0.015625) << told_s;
    EXPECT_EQ(made(raw, {.stamp_is = StampIs::last_beam, .sweep_time_s = told_s}).stamp().ns,
              raw.stamp.ns - 15'625'000)
        << told_s;
    EXPECT_EQ(made(silent, {.sweep_time_s = told_s}).sweep_time_s(), 0.0) << told_s;
  }
  EXPECT_EQ(made(sweep(1, 1.0), {.stamp_is = StampIs::last_beam, .sweep_time_s = 1.0}).stamp(), raw.stamp)
      << "one beam is no sweep";
}

TEST(Scan, IntensitiesAreFinite) {
  RawScan raw = with_ranges({1.0F, 2.0F, 3.0F, 4.0F});
  raw.intensities = {kNan, kInf, -kInf, 9.0F};
  EXPECT_THAT(made(raw).intensities(), ElementsAre(0.0F, 0.0F, 0.0F, 9.0F));
}

TEST(Scan, RefusesWhatIsNoSweepAndSaysWhere) {
  const auto refused = [](auto spoil) {
    RawScan raw = sweep(10, 1.0);
    spoil(raw);
    const auto scan = Scan::make(raw);
    EXPECT_FALSE(scan.ok());
    if (scan.ok()) return std::string();
    EXPECT_EQ(scan.error().where, "scan at 1000.000000000");
    return scan.error().what;
  };
  EXPECT_THAT(refused([](RawScan& raw) { raw.ranges_m.clear(); }), HasSubstr("no beams"));
  EXPECT_THAT(refused([](RawScan& raw) { raw.ranges_m.resize(Scan::kMaxBeams + 1); }),
              HasSubstr("1000001 beams"));
  EXPECT_THAT(refused([](RawScan& raw) { raw.intensities.resize(9); }),
              HasSubstr("9 intensities for 10 ranges"));
  for (const float step : {0.0F, -0.0F, 1e-9F, -1e-9F, 3.3F, -1e30F, kNan, kInf, -kInf})
    EXPECT_THAT(refused([&](RawScan& raw) { raw.angle_increment_rad = step; }),
                HasSubstr("angle_increment is "))
        << step;
  for (const float first : {kNan, kInf, -kInf, 1e30F})
    EXPECT_THAT(refused([&](RawScan& raw) { raw.angle_min_rad = first; }), HasSubstr("angle_min is "))
        << first;
  EXPECT_THAT(refused([](RawScan& raw) { raw.range_min_m = 40.0F; }),
              HasSubstr("40.000000 m is not below range_max 30.0"));
}

TEST(Scan, TakesAsManyBeamsAsItPromises) {
  RawScan raw = sweep(0, 1.0);
  raw.angle_increment_rad = 5e-6F;
  raw.ranges_m.assign(Scan::kMaxBeams, 1.0F);
  EXPECT_EQ(made(raw).hit_count(), Scan::kMaxBeams);
}

// Whatever bits a file brings: either an Error, or a Scan that keeps what its header promises.
TEST(Scan, IsSoundForAnyBits) {
  Rng rng(2);
  const auto any_float = [&rng] {
    const float special[] = {kNan,  kInf,   -kInf, 0.0F,  -0.0F,  1.0F, -1.0F,
                             0.01F, -0.01F, 3.0F,  30.0F, 1e-40F, 3e38F};
    const auto pick = static_cast<std::size_t>(rng.uniform(0.0, 16.0));
    return pick < std::size(special) ? special[pick]
                                     : std::bit_cast<float>(static_cast<std::uint32_t>(rng.bits()));
  };
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    RawScan raw;
    raw.stamp = Stamp{static_cast<std::int64_t>(rng.bits())};
    raw.angle_min_rad = any_float();
    raw.angle_increment_rad = any_float();
    raw.time_increment_s = any_float();
    raw.scan_time_s = any_float();
    raw.range_min_m = any_float();
    raw.range_max_m = any_float();
    raw.ranges_m.resize(static_cast<std::size_t>(rng.uniform(0.0, 20.0)));
    for (float& range_m : raw.ranges_m) range_m = any_float();
    if (rng.uniform() < 0.5) raw.intensities.assign(raw.ranges_m.size(), any_float());
    const auto scan = Scan::make(raw, {.stamp_is = StampIs::last_beam});
    if (!scan.ok()) continue;
    ++accepted;
    ASSERT_GT(scan->size(), 0U);
    ASSERT_LE(scan->size(), raw.ranges_m.size());
    ASSERT_GT(scan->angle_increment_rad(), 0.0);
    ASSERT_LT(scan->range_min_m(), scan->range_max_m());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < scan->size(); ++i) {
      ASSERT_TRUE(std::isfinite(scan->x_m()[i]) && std::isfinite(scan->y_m()[i]));
      ASSERT_TRUE(std::isfinite(scan->beam_time_s(i)) && scan->beam_time_s(i) >= 0.0);
      ASSERT_TRUE(scan->intensities().empty() || std::isfinite(scan->intensities()[i]));
      if (!scan->is_hit(i)) continue;
      ++hits;
      const auto range_m = static_cast<double>(scan->ranges_m()[i]);
      ASSERT_TRUE(range_m > 0.0 && range_m >= scan->range_min_m() && range_m < scan->range_max_m());
    }
    ASSERT_EQ(scan->hit_count(), hits);
  }
  EXPECT_GT(accepted, 1000) << "the test has to reach past the refusals";
}

}  // namespace
}  // namespace beaconless
