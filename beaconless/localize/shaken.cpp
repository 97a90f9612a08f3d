// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/shaken.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace beaconless {
namespace {

constexpr double kThrough_s = 2.0;     // of beams through walls
constexpr double kShortest_s = 1.0;    // between doubts …
constexpr double kLongest_s = 30.0;    // … that follow each other
constexpr double kForgotten_s = 60.0;  // … and after which they are forgotten

}  // namespace

void Shaken::see_fit(Status status, bool was_lost) {
  const bool was_weak = std::exchange(is_weak_, status != Status::ok);
  is_shaken_ = is_shaken_ || was_lost || unfitted_scans_ >= kShaking;
  is_weakened_ = is_weakened_ || (is_weak_ && !was_weak);
  unfitted_scans_ = 0;
}

void Shaken::see_none(bool is_explained) {
  unfitted_scans_ = is_explained ? 0 : unfitted_scans_ + 1;
  is_shaken_ = is_shaken_ || unfitted_scans_ == kShaking;
}

bool Shaken::take(Stamp stamp, bool is_through_walls) {
  const bool is_weakened = is_long_through_walls(stamp, is_through_walls) || is_weakened_;
  if (!is_shaken_ && !is_weakened) return false;
  // 1. Not too soon after the last one.
  const double since_s = taken_ ? std::abs(seconds_between(*taken_, stamp)) : kForgotten_s;
  const bool is_soon = since_s < (is_shaken_ ? std::min(pause_s_, kShortest_s) : pause_s_);
  is_weakened_ = false;
  if (is_soon) return false;
  // 2. The next one of its kind twice as late, unless all has been quiet for long.
  pause_s_ = since_s >= kForgotten_s ? kShortest_s : std::min(2.0 * pause_s_, kLongest_s);
  taken_ = stamp;
  is_shaken_ = false;
  return true;
}

bool Shaken::is_long_through_walls(Stamp stamp, bool is_through_walls) {
  if (!is_through_walls) through_since_.reset();
  if (is_through_walls && !through_since_) through_since_ = stamp;
  if (!through_since_ || std::abs(seconds_between(*through_since_, stamp)) < kThrough_s) return false;
  through_since_ = stamp;
  return true;
}

}  // namespace beaconless
