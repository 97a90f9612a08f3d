// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// Tells how far a pose deserves trust by what scans say for and against it.
///
/// What the map does not explain is no reason for doubt as long as it is in front of the map's walls: people
/// and new things stand there. Beams that pass through walls are one, and so is a fit whose beams end about
/// walls instead of on them. A few beams of every scan are followed, others each time. Allocates nothing.
class Trust {
 public:
  /// Forgets what it has seen.
  void begin();

  /// Takes in a scan and the pose it was fitted to. In: its points in the laser frame; `slack_m`, by how much
  /// walls may be off. Cost: some dozens of nearest look-ups a beam that is followed, kBeams of them, more
  /// with the first scan.
  void see(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const MatchResult& match,
           double slack_m);

  /// 0 … 1, of the scans so far.
  double quality() const;
  /// Share of beams that pass through walls.
  double through() const { return through_; }

  static constexpr std::size_t kBeams = 24;

 private:
  double through_ = 0.0;
  double on_map_ = 0.0;
  double blur_ = 0.0;  // of the beams that end on the map, 0 on its walls, 1/3 anywhere near
  std::size_t seen_ = 0;
};

}  // namespace beaconless
