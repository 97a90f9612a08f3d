// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// When a fit counts as good, weak or lost.
struct HealthConfig {
  double doubt_share =
      0.9;  ///< a fit that explains less than this share of what is usual here is tried elsewhere too
  double weak_share = 0.75;   ///< … and less than this is weak
  double weak_ratio = 0.35;   ///< a fit that explains less of the scan than this is weak in any case
  double found_ratio = 0.5;   ///< a robot is found, at the start or again, by a fit that explains this much
  double lost_ratio = 0.25;   ///< a fit that explains less than this is no fit
  int lost_after_scans = 8;   ///< so many weak fits in a row, and the robot is lost …
  double lost_after_s = 0.6;  ///< … or such a time of them, three or more
  int found_after_scans = 5;  ///< a lost robot is found when so many fits in a row agree
  double forget = 0.05;       ///< how fast "usual" follows the scans
};

void describe(Fields& fields, HealthConfig& config);

/// Judges each scan's fit by the share of its points that lie on the map, against what is usual in this
/// place.
///
/// People and clutter lower the share for a while; a wrong pose lowers it sharply. What is usual is learnt
/// from good fits only.
class Health {
 public:
  explicit Health(const HealthConfig& config = {}) : config_(config) {}

  /// True where a fit is not to be believed without trying other starts.
  bool is_doubtful(double on_map_ratio) const {
    return is_weak(on_map_ratio) || on_map_ratio < config_.doubt_share * usual_ratio_;
  }

  /// True where a fit explains too little to be trusted by itself.
  bool is_weak(double on_map_ratio) const;

  /// Takes in the scan's final fit; gives ok, degraded or lost.
  Status judge(Stamp stamp, double on_map_ratio);

  /// True after a good fit, until lost: then a fit need not convince by itself.
  bool at_home() const { return usual_ratio_ > 0.0 && !lost(); }

  bool lost() const { return lost_; }

  /// A place that fitted turned out not to be the robot's: counting starts again.
  void forget_found() { good_in_a_row_ = 0; }

 private:
  HealthConfig config_;
  double usual_ratio_ = 0.0;
  int weak_in_a_row_ = 0;
  Stamp weak_since_;
  int good_in_a_row_ = 0;
  bool lost_ = false;
};

}  // namespace beaconless
