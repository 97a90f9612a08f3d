// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace beaconless {

/// What the straight pieces of a scan hold of a pose, told by the scan itself: Σ J Jᵀ of its points, J = (n,
/// n × arm) with n across the piece that a point belongs to.
///
/// Add the points in the order of the scan, as arms from the laser, all along the same axes. Pieces are runs
/// of points as long as `piece_m`; what is bent there (corners, round things) is left out. Cost: some 15
/// operations a point. Source: the information of a range scan, Censi, "On achievable accuracy for
/// range-finder localization", ICRA 2007, with the incidence left out.
class StraightPieces {
 public:
  explicit StraightPieces(double piece_m) : piece_m2_(piece_m * piece_m) {}

  void add(const Eigen::Vector2d& arm);

  /// Ends the last piece. `count` is of points on straight pieces.
  struct Held {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    int count = 0;
  };
  Held finish();

 private:
  void end_piece();

  double piece_m2_;
  Held held_;
  int count_ = 0;  // of the piece at hand
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();  // of points from the first
  Eigen::Matrix2d squares_ = Eigen::Matrix2d::Zero();
};

}  // namespace beaconless
