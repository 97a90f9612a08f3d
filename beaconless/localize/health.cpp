// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/health.hpp"

#include <algorithm>

namespace beaconless {
namespace {

constexpr int kFewest = 3;  // weak fits, however slow the scanner, that make a robot lost

}  // namespace

void describe(Fields& fields, HealthConfig& config) {
  fields("doubt_share", config.doubt_share, {0.0, 1.0},
         "a fit below this share of the usual one is tried elsewhere too");
  fields("weak_share", config.weak_share, {0.0, 1.0}, "a fit below this share of the usual one is weak");
  fields("weak_ratio", config.weak_ratio, {0.0, 1.0},
         "a fit that explains less of the scan than this is weak");
  fields("found_ratio", config.found_ratio, {0.0, 1.0},
         "a robot is found, at the start or again, by a fit that explains this share of the scan");
  fields("lost_ratio", config.lost_ratio, {0.0, 1.0},
         "a fit that explains less of the scan than this is no fit");
  fields("lost_after_scans", config.lost_after_scans, {1, 100000}, "so many weak fits in a row mean lost …");
  fields("lost_after_s", config.lost_after_s, {0.0, 1000.0},
         "… and so do three or more within no less than this");
  fields("found_after_scans", config.found_after_scans, {1, 100000},
         "a lost robot is found when so many fits in a row agree");
  fields("forget", config.forget, {0.0, 1.0}, "how fast what is usual follows the scans");
}

bool Health::is_weak(double on_map_ratio) const {
  if (at_home()) return on_map_ratio < std::max(config_.weak_ratio, config_.weak_share * usual_ratio_);
  return on_map_ratio < std::max(config_.found_ratio, config_.doubt_share * usual_ratio_);
}

Status Health::judge(Stamp stamp, double on_map_ratio) {
  if (is_weak(on_map_ratio)) {
    good_in_a_row_ = 0;
    if (weak_in_a_row_++ == 0) weak_since_ = stamp;
    const bool is_long =
        weak_in_a_row_ >= kFewest && seconds_between(weak_since_, stamp) >= config_.lost_after_s;
    lost_ = lost_ || is_long || weak_in_a_row_ >= config_.lost_after_scans;
    // What was usual elsewhere must not keep a robot lost for ever; but a fit that is weak all of a sudden
    // teaches nothing before that.
    if (lost_ && usual_ratio_ > 0.0 && on_map_ratio >= config_.weak_ratio)
      usual_ratio_ += config_.forget * (on_map_ratio - usual_ratio_);
    return lost_ || on_map_ratio < config_.lost_ratio ? Status::lost : Status::degraded;
  }
  if (lost_ && ++good_in_a_row_ < config_.found_after_scans) return Status::degraded;
  lost_ = false;
  weak_in_a_row_ = 0;
  const double follow = usual_ratio_ > 0.0 ? config_.forget : 1.0;
  usual_ratio_ += follow * (on_map_ratio - usual_ratio_);
  return Status::ok;
}

}  // namespace beaconless
