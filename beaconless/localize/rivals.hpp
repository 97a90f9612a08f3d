// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// Other places than the one taken that fit a scan about as well, so that it cannot tell which of them it is.
///
/// All poses are map_from_laser. Allocates nothing once its lists have grown.
class Rivals {
 public:
  /// Notes a fit of the scan at hand, wherever it came to lie.
  void note(const MatchResult& fit) { tried_.push_back(fit); }
  void forget_notes() { tried_.clear(); }
  void clear();

  /// Makes rivals of the fits noted that are elsewhere and as good as the one taken.
  void look(const MatchResult& taken);

  /// Fits the next scan where each rival has moved to with the robot (`moved`, the pose taken last as seen
  /// from which is the one taken now); those that have fitted no more for some scans in a row are dropped.
  /// True where one has come to fit better and is `taken` now.
  template <class Fit>
  bool follow(MatchResult& taken, const Pose2& moved, const Fit& fit) {
    forget_notes();
    bool is_other = false;
    for (Place& place : places_) {
      place.map_from_laser = place.map_from_laser * moved;
      MatchResult rival = fit(place.map_from_laser);
      const bool is_place = rival.usable() && is_elsewhere(rival.map_from_laser, taken.map_from_laser);
      if (is_place && !is_as_good(taken, rival)) {
        std::swap(rival, taken);
        is_other = true;
      }
      const bool is_rival = is_place && is_as_good(rival, taken);
      place.worse_scans = is_rival ? 0 : place.worse_scans + 1;
      if (is_rival) place.map_from_laser = rival.map_from_laser;
    }
    drop_known(taken.map_from_laser);
    return is_other;
  }

  bool any() const { return !places_.empty(); }

  /// What they add to the covariance of (x, y, theta) of the base: that the pose may be theirs.
  Eigen::Matrix3d covariance(const Pose2& map_from_base, const Pose2& laser_from_base) const;

 private:
  struct Place {
    Pose2 map_from_laser;
    int worse_scans = 0;  ///< in a row
  };

  void drop_known(const Pose2& taken);
  static bool is_elsewhere(const Pose2& a, const Pose2& b);
  static bool is_as_good(const MatchResult& a, const MatchResult& b);

  std::vector<MatchResult> tried_;
  std::vector<Place> places_;
};

}  // namespace beaconless
