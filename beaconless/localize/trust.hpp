// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// Tells how far a pose deserves trust by what scans say for and against it.
///
/// What the map does not explain is no reason for doubt as long as it is in front of the map's walls: people
/// and new things stand there, the map has changed. Beams that pass through walls are one, and so is a fit
/// whose beams end about walls instead of on them: the robot is in the wrong place. A few beams of every scan
/// are followed, others each time. Allocates nothing.
class Trust {
 public:
  /// Forgets what it has seen.
  void begin();

  /// Takes in a scan and what it was fitted to. In: its points in the laser frame; `slack_m`, by how much
  /// walls may be off. Cost: some ten nearest look-ups a beam that is followed: kBeams, more with the first
  /// scan.
  void see(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const MatchResult& match,
           double slack_m);

  /// 0 … 1, by the scans so far: where it is 0.5 or more, hardly one pose in a thousand is wrong.
  ///
  /// In: the protection level (m) of the pose, nothing where the method tells none: a pose that hangs on few
  /// beams falls with them. Source: logistic regression on the simulations of bench/trust_study, see
  /// docs/concepts/trust.md.
  double quality(std::optional<double> protection_m) const;

  /// Share of beams that pass through walls, of late.
  double through() const { return through_; }

  static constexpr std::size_t kBeams = 24;

 private:
  double through_ = 0.0;
  double blur_ = 0.0;  // of the beams that end on the map: 0 on its walls, 1/3 anywhere near
  std::size_t seen_ = 0;
};

}  // namespace beaconless
