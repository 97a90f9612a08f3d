// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/shaken.hpp"

#include <utility>

namespace beaconless {
namespace {

constexpr double kThrough_s = 2.0;  // of beams through walls

}  // namespace

void Shaken::see_fit(Status status, bool was_lost) {
  const bool was_weak = std::exchange(is_weak_, status != Status::ok);
  is_shaken_ = is_shaken_ || was_lost || unfitted_scans_ >= kShaking || (is_weak_ && !was_weak);
  unfitted_scans_ = 0;
}

void Shaken::see_none(bool is_explained) {
  unfitted_scans_ = is_explained ? 0 : unfitted_scans_ + 1;
  is_shaken_ = is_shaken_ || unfitted_scans_ == kShaking;
}

bool Shaken::take(Stamp stamp, bool is_through_walls) {
  const bool is_through = is_long_through_walls(stamp, is_through_walls);
  return std::exchange(is_shaken_, false) || is_through;
}

bool Shaken::is_long_through_walls(Stamp stamp, bool is_through_walls) {
  if (!is_through_walls) through_since_.reset();
  if (is_through_walls && !through_since_) through_since_ = stamp;
  if (!through_since_ || seconds_between(*through_since_, stamp) < kThrough_s) return false;
  through_since_ = stamp;
  return true;
}

}  // namespace beaconless
