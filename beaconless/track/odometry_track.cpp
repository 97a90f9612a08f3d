// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/odometry_track.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace beaconless {
namespace {

constexpr double kMoved_m = 0.01;
constexpr double kMoved_rad = 0.01;
constexpr double kCoveredShare = 0.5;  // of the time between two moments, at least
constexpr double kLeast_s = 1e-4;
constexpr double kAgrees = 16.0;  // squared standard deviations
constexpr int kDistrust = -20;    // scans that must agree, besides the usual ones, after one that did not

}  // namespace

void describe(Fields& fields, OdometryConfig& config) {
  fields("use", config.use, "odometry helps where a recording has it and it agrees with the laser");
  fields("share", config.share, {0.0, 1.0}, "of a speed that odometry is off by");
  fields("sigma_mps", config.sigma_mps, {0.0, 10.0}, "and by how much in any case");
  fields("sigma_radps", config.sigma_radps, {0.0, 10.0}, "the same of its rate of turn");
}

void OdometryTrack::add(Stamp stamp, const Pose2& odom_from_base) {
  if (!config_.use || !odom_from_base.is_finite()) return;
  if (count_ > 0 && !(seconds_between(entry(0).stamp, stamp) > 0.0)) count_ = 0;
  if (count_ == 0) begun_at_ = odom_from_base;
  has_moved_ = has_moved_ || distance_m(begun_at_, odom_from_base) > kMoved_m ||
               heading_difference_rad(begun_at_, odom_from_base) > kMoved_rad;
  entries_[next_] = {stamp, odom_from_base};
  next_ = (next_ + 1) % kRoom;
  count_ = std::min(count_ + 1, kRoom);
}

OdometryTrack::Entry OdometryTrack::at(Stamp stamp) const {
  for (std::size_t age = 0; age + 1 < count_; ++age) {
    const Entry& after = entry(age);
    const Entry& before = entry(age + 1);
    const double past_s = seconds_between(before.stamp, stamp);
    if (past_s < 0.0) continue;
    const double fraction = past_s / seconds_between(before.stamp, after.stamp);
    if (fraction > 1.0) return after;
    return {stamp, interpolate(before.odom_from_base, after.odom_from_base, fraction)};
  }
  return entry(count_ - 1);
}

std::optional<ToldTwist> OdometryTrack::between(Stamp from, Stamp to) const {
  const double asked_s = seconds_between(from, to);
  if (!has_moved_ || count_ < 2 || !(asked_s > kLeast_s)) return std::nullopt;
  const Entry first = at(from);
  const Entry last = at(to);
  const double covered_s = seconds_between(first.stamp, last.stamp);
  if (covered_s < kCoveredShare * asked_s) return std::nullopt;
  ToldTwist told;
  told.per_s = (first.odom_from_base.inverse() * last.odom_from_base).log().vector() / covered_s;
  const double move = std::hypot(config_.sigma_mps, config_.share * told.per_s.head<2>().norm());
  const double turn = std::hypot(config_.sigma_radps, config_.share * told.per_s.z());
  told.covariance = Eigen::Vector3d(move * move, move * move, turn * turn).asDiagonal();
  return told;
}

void OdometryTrack::compare(Stamp from, Stamp to, const ToldTwist& seen) {
  const auto told = between(from, to);
  if (!told) {
    agreed_ = std::min(agreed_, 0);  // and what was distrusted stays so
    return;
  }
  const Eigen::Vector3d off = told->per_s - seen.per_s;
  const Eigen::Matrix3d expected = told->covariance + seen.covariance + 1e-12 * Eigen::Matrix3d::Identity();
  const bool agrees = off.dot(expected.ldlt().solve(off)) < kAgrees;
  agreed_ = agrees ? std::min(agreed_ + 1, kAgreed) : kDistrust;
}

}  // namespace beaconless
