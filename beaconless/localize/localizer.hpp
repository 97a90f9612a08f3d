// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "beaconless/event.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// A part of the map, where the base is: a disc.
struct SearchRegion {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// A place where the robot may be, by the scans since it was last known where it is.
struct PoseCandidate {
  Pose2 map_from_base;
  double score = 0.0;   ///< 0 … 1: share of the last scan that is explained from there
  double weight = 0.0;  ///< 0 … 1: how likely it is this one; those of all candidates add up to 1
};

/// What one of several lasers told last, by itself.
struct LaserSays {
  std::string_view frame_id;
  PoseEstimate estimate;
};

/// A complete pipeline on a known map: events in, estimates out.
class Localizer {
 public:
  virtual ~Localizer() = default;

  /// Sets the belief: the robot's base stands about here now.
  virtual void start_at(const Pose2& map_from_base) = 0;

  /// Sets the belief: the robot stands anywhere, or anywhere within a region. The next scans find it, or tell
  /// that several places fit. Nothing is guessed, but by the particles of `amcl`: those may settle on one of
  /// two like places, and their quality stays below 0.5.
  virtual void start_anywhere(const std::optional<SearchRegion>& within = std::nullopt) = 0;

  /// The places that fit, the likeliest first; empty where the pose is known, or nothing fits. Valid until
  /// the next call of any of the others.
  virtual std::span<const PoseCandidate> candidates() const = 0;

  /// What each laser told last, where there are several. Valid until the next call of any of the others.
  virtual std::span<const LaserSays> lasers() const { return {}; }

  /// Takes in one event. Total: any event in any state gives an estimate with a status, and no NaN.
  virtual PoseEstimate update(const Event& event) = 0;
};

}  // namespace beaconless
