// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace beaconless {

/// Tells by a long and a short mean of how well the cloud explains scans what share of it should be put
/// anywhere, because it may be in the wrong place.
///
/// Source: Thrun et al., table 8.3 (augmented MCL). Differs: what goes in is the geometric mean of a beam's
/// likelihood, since the product over all beams differs by orders of magnitude from one place to the next;
/// only a drop by more than kUsual counts; ROS's amcl forgets both means after it has put one particle
/// anywhere, and then has nothing to compare with.
class MeanWeights {
 public:
  static constexpr double kUsual = 0.85;  ///< of the long mean: people and clutter lower the short one

  MeanWeights(double alpha_slow, double alpha_fast) : alpha_slow_(alpha_slow), alpha_fast_(alpha_fast) {}

  void add(double likelihood) {
    slow_ += (has_any_ ? alpha_slow_ : 1.0) * (likelihood - slow_);
    fast_ += (has_any_ ? alpha_fast_ : 1.0) * (likelihood - fast_);
    if (alpha_slow_ > 0.0) slow_ += kRise * std::max(0.0, fast_ - slow_);
    has_any_ = true;
  }

  /// 0 … 1. 0 where recovery is switched off.
  double lost_share() const {
    if (!(alpha_slow_ > 0.0) || !(slow_ > 0.0)) return 0.0;
    return std::max(0.0, 1.0 - fast_ / (kUsual * slow_));
  }

  double slow() const { return slow_; }
  double fast() const { return fast_; }
  void forget() { *this = MeanWeights(alpha_slow_, alpha_fast_); }

 private:
  static constexpr double kRise = 0.05;  // a cloud that has come together teaches what is usual sooner

  double alpha_slow_;
  double alpha_fast_;
  double slow_ = 0.0;
  double fast_ = 0.0;
  bool has_any_ = false;
};

}  // namespace beaconless
