// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// How a robot may change its motion from one scan to the next.
struct MotionConfig {
  double acceleration_mps2 = 1.0;         ///< standard deviation of what the speed may change in a second
  double turn_acceleration_radps2 = 1.5;  ///< … and the rate of turn
  double start_sigma_m = 0.25;            ///< how well a start pose is known, to each side
  double start_sigma_deg = 15.0;          ///< … and its heading
  double max_gap_s = 1.0;                 ///< after a longer silence the robot is taken to stand where it was
};

void describe(Fields& fields, MotionConfig& config);

/// A velocity in the base frame, and how sure it is.
struct ToldTwist {
  Eigen::Vector3d per_s = Eigen::Vector3d::Zero();  ///< m/s, m/s, rad/s
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Where the robot should be now, and how sure that is.
struct Prediction {
  Pose2 map_from_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  ToldTwist motion;  ///< from now on
};

/// Carries the motion of the last poses on to the next scan: constant velocity, no odometry needed.
///
/// Every new pose tells a velocity, which is believed by its own noise against what accelerations allow: two
/// scans half a millisecond apart say nothing about speed, two scans half a second apart say it all. Source:
/// dissertation 4.4 works without wheels; Kalman filter of a velocity that walks randomly, by as much as it
/// changed of late. Differs: where stamps stand still or run backwards the usual interval is assumed.
class MotionFilter {
 public:
  explicit MotionFilter(const MotionConfig& config = {}) : config_(config) {}

  void start_at(const Pose2& map_from_base);

  Prediction predict(Stamp stamp) const;

  /// The motion from `stamp` on, as far as is known of it. What has happened since the last pose is in its
  /// variance.
  ToldTwist motion_at(Stamp stamp) const;

  /// Tells the filter where the robot was at `stamp`, and how sure that is.
  void correct(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance);

  /// The mean velocity from the last pose to another one; nothing before the first.
  std::optional<ToldTwist> told_by(Stamp stamp, const Pose2& map_from_base,
                                   const Eigen::Matrix3d& covariance) const;

  /// Whether a velocity that was measured otherwise, over `lasting_s` from the last pose on, is not far from
  /// what is possible.
  bool is_possible(const ToldTwist& told, double lasting_s) const;

  /// Tells it of a velocity that was measured otherwise, as the mean of `lasting_s` from the last pose on.
  /// Not heard, and false, where it is far from what is possible: a slipping wheel, a jump of somebody's
  /// estimate.
  bool hear(const ToldTwist& told, double lasting_s);

  /// Tells it of a pose that rests on its own prediction, wholly or along some direction: the velocity is
  /// believed as before and less, since nothing new was heard of it.
  void hold(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance);

 private:
  MotionConfig config_;
  Pose2 last_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Stamp stamp_;
  bool stamped_ = false;
  double usual_step_s_ = 0.0;  // 0: no two poses yet
  ToldTwist motion_;           // at the last pose

  Eigen::Vector3d lately_ = Eigen::Vector3d::Ones();  // squared change of motion, as a share of what may be

  double elapsed_s(Stamp stamp) const;
  double since_told_s(double lasting_s) const;
  Eigen::Vector3d possible_change(double elapsed_s) const;
  Eigen::Matrix3d expected_change(double elapsed_s) const;
  void note_change(const ToldTwist& told, double elapsed_s, double noise);
  void set(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance);
  void take(const ToldTwist& told);
};

}  // namespace beaconless
