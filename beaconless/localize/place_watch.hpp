// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/localize/place_finder.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// Holds the place where a robot is followed against others of the map, as long as it is in doubt.
///
/// A place found by a search of the map may be the likeliest of several: it is in doubt until a drive has
/// left nothing else. A place where the robot was followed comes into doubt when scans stopped fitting for a
/// moment, for then it may have been carried off, and what fits near by need not be where it is. Cost: a
/// search of the map with each view of PlaceFinder, a fit a place ten times a second, nothing without doubt.
class PlaceWatch {
 public:
  enum class Finding {
    beyond_doubt,  ///< nothing else fits
    in_doubt,      ///< other places are not far behind, or nothing was told
    rivalled,      ///< others fit about as well
    elsewhere,     ///< others fit far better
  };

  /// `finder` is shared with who searches, one at a time, and outlives this.
  explicit PlaceWatch(PlaceFinder& finder) : finder_(&finder) {}

  void forget();  ///< there is no doubt
  void doubt_found(
      Stamp stamp,
      const Pose2& map_from_laser);  ///< the finder has just found the place, and goes on from what it knows
  void doubt_followed(const Pose2& map_from_laser);  ///< a robot that was followed there may be elsewhere
  bool is_in_doubt() const { return in_doubt_; }
  Finding finding() const { return in_doubt_ ? finding_ : Finding::beyond_doubt; }  ///< the last one

  /// Takes in a scan, laser frame, that was fitted at `map_from_laser`, or was found not to fit there.
  Finding see(Stamp stamp, std::span<const Eigen::Vector2d> points, const Pose2& map_from_laser,
              bool is_fitted);

 private:
  void begin(double reach_m);
  void judge_or_wait(PlaceFinder::Verdict verdict, const Pose2& map_from_laser, bool is_fitted);
  Finding judge(const Pose2& map_from_laser, bool is_fitted);

  PlaceFinder* finder_;
  bool in_doubt_ = false;
  double reach_m_ = std::numeric_limits<double>::infinity();  ///< how far off others matter
  std::optional<Stamp> seen_;
  std::optional<Pose2> was_;  ///< map_from_laser then
  Finding finding_ = Finding::in_doubt;
  double pause_s_ = 0.0;  ///< before the next look
  int absent_ = 0;        ///< looks in a row that do not have the place among the likely ones
};

/// Takes from the estimate of a robot that is followed what a finding leaves in doubt.
void doubt(PoseEstimate& estimate, PlaceWatch::Finding finding);

}  // namespace beaconless
