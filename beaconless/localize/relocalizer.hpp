// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/place_finder.hpp"

namespace beaconless {

/// Finds a robot that may be anywhere: places from scans by PlaceFinder, and one of them taken when enough
/// scans agree on it.
class Relocalizer {
 public:
  /// `finder` outlives this.
  Relocalizer(PlaceFinder& finder, const Pose2& laser_from_base)
      : laser_from_base_(laser_from_base), finder_(&finder) {}

  /// Forgets all; the laser is in this box, and so many scans in a row must agree, or a few over a while.
  void begin(const FloorPlan::Bounds& box, int agreeing_scans, PlaceFinder::Wanted wanted = {});
  void forget() { candidates_.clear(); }

  /// Takes in a scan: what is known of the pose, or nothing once it is found.
  ///
  /// In: points in the laser frame; how the laser has moved since the last scan, where that is known; where
  /// the base was believed to be last, which stands in while nothing fits. Cost: see PlaceFinder::see().
  std::optional<PoseEstimate> see(Stamp stamp, std::span<const Eigen::Vector2d> points,
                                  const std::optional<Pose2>& moved, const Pose2& believed);
  Pose2 found() const { return base_at(finder_->places().front()); }  ///< map_from_base

  /// The estimate where a scan tells nothing.
  PoseEstimate nowhere(Stamp stamp, const Pose2& believed, std::string_view reason);

  /// Whether one scan alone fits where the base is believed to be and nowhere else; forgets all. Cost: a
  /// search of the whole map.
  bool is_only_at(const Pose2& map_from_base, Stamp stamp, std::span<const Eigen::Vector2d> points);

  std::span<const PoseCandidate> candidates() const { return candidates_; }

 private:
  Pose2 base_at(const PlaceFinder::Place& place) const { return place.map_from_laser * laser_from_base_; }
  bool agrees(Stamp stamp) const;
  PoseEstimate searching(Stamp stamp, PlaceFinder::Verdict verdict) const;

  Pose2 laser_from_base_;
  PlaceFinder* finder_;
  std::vector<PoseCandidate> candidates_;
  int agreeing_scans_ = 1;
  int agreed_scans_ = 0;
  Stamp agreed_since_;
  Stamp agreed_last_;
  Pose2 agreed_on_;  // map_from_laser then
};

}  // namespace beaconless
