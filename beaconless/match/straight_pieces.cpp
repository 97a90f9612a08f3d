// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/straight_pieces.hpp"

#include <cmath>

namespace beaconless {
namespace {

constexpr int kFewest = 4;             // points that tell a direction
constexpr double kBent = 0.1;          // variance across a piece, as a share of that along it …
constexpr double kThick = 1.0 / 64.0;  // … and of its square length

}  // namespace

void StraightPieces::add(const Eigen::Vector2d& arm) {
  if (count_ == 0) first_ = arm;
  const Eigen::Vector2d from_first = arm - first_;
  sum_ += from_first;
  squares_ += from_first * from_first.transpose();
  ++count_;
  if (count_ >= kFewest && from_first.squaredNorm() >= piece_m2_) end_piece();
}

StraightPieces::Held StraightPieces::finish() {
  end_piece();
  return held_;
}

void StraightPieces::end_piece() {
  const int count = count_;
  const double n = count;
  const Eigen::Vector2d mean = sum_ / std::max(n, 1.0);
  const Eigen::Matrix2d scatter = squares_ - n * mean * mean.transpose();
  const Eigen::Matrix2d squares = squares_;
  const Eigen::Vector2d sum = sum_;
  count_ = 0;
  sum_.setZero();
  squares_.setZero();
  if (count < kFewest) return;

  // 1. The direction across: the smaller axis of the scatter, from whichever of its rows is the larger.
  const double half_difference = 0.5 * (scatter(0, 0) - scatter(1, 1));
  const double radius = std::sqrt(half_difference * half_difference + scatter(0, 1) * scatter(0, 1));
  const double across_m2 = 0.5 * scatter.trace() - radius;
  const double along_m2 = across_m2 + 2.0 * radius;
  if (!(across_m2 < kBent * along_m2 && across_m2 < kThick * piece_m2_ * n)) return;
  const Eigen::Vector2d across =
      (half_difference > 0.0 ? Eigen::Vector2d(-scatter(0, 1), half_difference + radius)
                             : Eigen::Vector2d(half_difference - radius, scatter(0, 1)))
          .normalized();

  // 2. Sums over the points of (n, n × arm): the moments do.
  const Eigen::Vector2d turned(across.y(), -across.x());  // n × arm = turned . arm
  const Eigen::Vector2d arms = sum + n * first_;
  const double lever = turned.dot(arms);
  const double first = turned.dot(first_);
  const double levers = turned.dot(squares * turned) + 2.0 * first * turned.dot(sum) + n * first * first;
  Eigen::Matrix3d& h = held_.information;
  h.topLeftCorner<2, 2>() += n * across * across.transpose();
  h.topRightCorner<2, 1>() += lever * across;
  h.bottomLeftCorner<1, 2>() += lever * across.transpose();
  h(2, 2) += levers;
  held_.count += count;
}

}  // namespace beaconless
