// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// The window around a guess that is searched when the guess alone leads nowhere.
struct LocalSearchConfig {
  double window_m = 0.4;
  double step_m = 0.1;
  double window_deg = 40.0;
  double step_deg = 2.5;
  int points = 120;           ///< of the scan, evenly taken
  double truncate_m = 0.3;    ///< a point further from every wall than this says no more than "not here"
  double far_penalty = 0.05;  ///< cost of a start at the window's edge, as a share of the worst cost
  int lost_stride = 4;        ///< a lost robot searches a wider window with every so many scans
  int keep = 4;               ///< best starts to return
};

void describe(Fields& fields, LocalSearchConfig& config);

/// A pose worth starting from.
struct StartPose {
  Pose2 map_from_laser;
  double cost = 0.0;  ///< 0 … 1 + far_penalty; smaller is better
};

/// Scores every pose of a window around a guess by how near the scan's points fall to the map, and returns
/// the best ones, best first, no two of them neighbours.
///
/// Cost: poses x points nearest look-ups (2673 x 120 by default, a few milliseconds): for times of trouble
/// only. Source: Olson, "Real-time correlative scan matching", 2009, one level. Differs: truncated squared
/// distances instead of a blurred image.
std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const WallIndex& map,
                                     const Pose2& guess, const LocalSearchConfig& config);
std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const CellIndex& map,
                                     const Pose2& guess, const LocalSearchConfig& config);
std::vector<StartPose> search_around(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                                     const Pose2& guess, const LocalSearchConfig& config);

}  // namespace beaconless
