// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/vector_loop.hpp"
#include "beaconless/match/wall_marks.hpp"

namespace beaconless {

/// Beams and the walls that they hit, as a loop over many at once wants them. Everything is in the frame of
/// the laser at the pose where they were paired, so that no number is large.
struct WallBeams {
  static constexpr std::size_t kLanes = 4;

  std::vector<double> x_m;  ///< end of the beam
  std::vector<double> y_m;
  std::vector<double> ux;  ///< its direction, unit
  std::vector<double> uy;
  std::vector<double> nx;  ///< normal of its wall, unit, pointing away from the laser: n · p = offset
  std::vector<double> ny;
  std::vector<double> offset_m;
  std::vector<double> information;  ///< 1/variance of its range, 1/m²
  std::size_t count = 0;
  std::vector<std::uint32_t> starts;  ///< beams that are on another wall than the one before them
  std::size_t start_count = 0;

  void clear() { count = start_count = 0; }
  /// Makes room for so many beams. Allocates only to hold more than ever before.
  void reserve(std::size_t beams);
  /// Where there is room for one more.
  void add(const Eigen::Vector2d& end, const Eigen::Vector2d& direction, const Eigen::Vector2d& normal,
           double offset, double known) {
    x_m[count] = end.x();
    y_m[count] = end.y();
    ux[count] = direction.x();
    uy[count] = direction.y();
    nx[count] = normal.x();
    ny[count] = normal.y();
    offset_m[count] = offset;
    information[count] = known;
    ++count;
  }
  /// Fills the last lanes with beams too far off their walls to be believed.
  void fill_up();
};

/// The sums of one Gauss-Newton step on Σ rho(e²/variance), e the range minus that to the wall, J its slope
/// by (x, y, theta) of the laser along the axes of the frame of the beams.
struct WallSums {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();   ///< Σ w J Jᵀ / variance
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< Σ w J e / variance; the step is -H⁻¹ of it
  double weight = 0.0;                                 ///< Σ w
  double weighted_squares = 0.0;                       ///< Σ w z², z = e / standard deviation
  double squared_influence = 0.0;                      ///< Σ (w z)²
  double curvature = 0.0;                              ///< Σ d(w z)/dz
  double arm_squares_m2 = 0.0;                         ///< Σ w of the squared distance from the laser
};

/// Sums over all beams with the laser moved by `step` from where they were paired.
///
/// In: Tukey's weights of z with an end at `cut` > 0; a loop that this processor knows; marks of that loop,
/// if any, which get the sums that a step is made of. Cost: some 60 operations a beam, two or four at once.
/// Source: Censi, "On achievable accuracy for range-finder localization", ICRA 2007 (J); Huber, "Robust
/// Statistics", 1981, 6.3 (the last sums).
WallSums sum_walls(const WallBeams& beams, const Pose2& step, double cut, VectorLoop loop,
                   WallMarks* marks = nullptr);

}  // namespace beaconless
