// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {
namespace {

constexpr double kNominalStep_s = 0.1;  // assumed between scans whose stamps do not tell
constexpr double kUnknownSpeed_mps = 1.0;
constexpr double kUnknownTurn_radps = 1.0;

double square(double value) { return value * value; }

/// How far a value is moved towards a measurement of it.
double gain(double variance, double noise_variance) { return variance / (variance + noise_variance + 1e-12); }

}  // namespace

void describe(Fields& fields, MotionConfig& config) {
  fields("acceleration_mps2", config.acceleration_mps2, {0.0, 100.0},
         "how much the speed may change in a second");
  fields("turn_acceleration_radps2", config.turn_acceleration_radps2, {0.0, 1000.0},
         "how much the rate of turn may change in a second");
  fields("start_sigma_m", config.start_sigma_m, {0.0, 1e3}, "how well a start pose is known, to each side");
  fields("start_sigma_deg", config.start_sigma_deg, {0.0, 180.0}, "and its heading");
  fields("max_gap_s", config.max_gap_s, {0.0, 1e6},
         "after a longer silence the robot is taken to stand where it was");
}

void MotionFilter::start_at(const Pose2& map_from_base) {
  *this = MotionFilter(config_);
  last_ = map_from_base;
  const double turn_rad = radians(config_.start_sigma_deg);
  covariance_ =
      Eigen::Vector3d(square(config_.start_sigma_m), square(config_.start_sigma_m), square(turn_rad))
          .asDiagonal();
}

double MotionFilter::elapsed_s(Stamp stamp) const {
  const double elapsed_s = seconds_between(stamp_, stamp);
  if (elapsed_s > 0.0) return elapsed_s;
  return usual_step_s_ > 0.0 ? usual_step_s_ : kNominalStep_s;
}

Prediction MotionFilter::predict(Stamp stamp) const {
  Prediction prediction{last_, covariance_, {}};
  if (!stamped_) return prediction;
  const double dt = elapsed_s(stamp);
  if (dt <= config_.max_gap_s) {
    prediction.twist_per_s = twist_per_s_;
    prediction.map_from_base = last_ * Pose2::exp(dt * twist_per_s_);
  }
  // The velocity may be wrong, and may have changed since.
  const double move_m2 = dt * dt * (speed_variance_ + square(config_.acceleration_mps2 * dt));
  const double turn_rad2 = dt * dt * (turn_variance_ + square(config_.turn_acceleration_radps2 * dt));
  prediction.covariance += Eigen::Vector3d(move_m2, move_m2, turn_rad2).asDiagonal();
  return prediction;
}

void MotionFilter::correct(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  const bool is_first = !stamped_;
  const double dt = is_first ? 0.0 : elapsed_s(stamp);
  const Pose2 before = last_;
  const Eigen::Matrix3d covariance_before = covariance_;
  hold(stamp, map_from_base, covariance);
  if (is_first) return;
  const Twist2 told = (1.0 / dt) * (before.inverse() * map_from_base).log();
  const Eigen::Matrix3d noise = (covariance_before + covariance) / (dt * dt);
  const double move_gain = gain(speed_variance_, 0.5 * noise.topLeftCorner<2, 2>().trace());
  const double turn_gain = gain(turn_variance_, noise(2, 2));
  twist_per_s_.x_m += move_gain * (told.x_m - twist_per_s_.x_m);
  twist_per_s_.y_m += move_gain * (told.y_m - twist_per_s_.y_m);
  twist_per_s_.theta_rad += turn_gain * (told.theta_rad - twist_per_s_.theta_rad);
  speed_variance_ *= 1.0 - move_gain;
  turn_variance_ *= 1.0 - turn_gain;
}

void MotionFilter::hold(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  if (stamped_) {
    const double dt = elapsed_s(stamp);
    speed_variance_ += square(config_.acceleration_mps2 * dt);
    turn_variance_ += square(config_.turn_acceleration_radps2 * dt);
    usual_step_s_ = dt;
  } else {
    speed_variance_ = square(kUnknownSpeed_mps);
    turn_variance_ = square(kUnknownTurn_radps);
  }
  last_ = map_from_base;
  covariance_ = covariance;
  stamp_ = stamp;
  stamped_ = true;
}

}  // namespace beaconless
