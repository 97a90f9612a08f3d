// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/scan/raw_scan.hpp"
#include "beaconless/sim/lidar.hpp"

#include "bench/trust/building.hpp"

namespace beaconless::trust {

/// Someone near the robot who sways along a line; follows the robot, or stands in the map.
struct Bystander {
  bool follows = false;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();    ///< from the robot, or in the map
  Eigen::Vector2d sway = Eigen::Vector2d::Zero();  ///< how far to either side
  double period_s = 4.0;
  double phase_rad = 0.0;
  double radius_m = 0.2;

  Eigen::Vector2d position_m(double time_s, const Eigen::Vector2d& robot) const;
};

/// A round part of the building whose walls give no echo.
struct Glass {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius_m = 1.0;
};

/// What a scanner meets that is on no map.
struct Disguise {
  std::vector<Bystander> people;
  std::vector<Glass> glass;
};

/// People until they hide a share of the beams where the laser is at `time_s`, as far as a crowd can.
std::vector<Bystander> make_crowd(double share, const sim::LidarConfig& lidar,
                                  const sim::LaserMotion& map_from_laser, double time_s, Rng& rng);

/// So many pieces of glass along walls that are not furniture.
std::vector<Glass> make_glass(const Building& building, int pieces, Rng& rng);

/// The share of the beams that end on people.
double hide(RawScan& scan, const Disguise& disguise, const sim::LidarConfig& lidar,
            const sim::LaserMotion& map_from_laser, Rng& rng);

}  // namespace beaconless::trust
