// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {
namespace {

constexpr double kNominalStep_s = 0.1;  // assumed between scans whose stamps do not tell

}  // namespace

void describe(Fields& fields, MotionConfig& config) {
  fields("acceleration_mps2", config.acceleration_mps2, {0.0, 100.0},
         "how much the speed may change in a second");
  fields("turn_acceleration_radps2", config.turn_acceleration_radps2, {0.0, 1000.0},
         "how much the rate of turn may change in a second");
  fields("max_gap_s", config.max_gap_s, {0.0, 1e6},
         "after a longer silence the robot is taken to stand where it was");
}

void MotionFilter::start_at(const Pose2& map_from_base) {
  *this = MotionFilter(config_);
  last_ = map_from_base;
}

Prediction MotionFilter::predict(Stamp stamp) const {
  if (!stamped_) return {last_, covariance_};
  double elapsed_s = seconds_between(stamp_, stamp);
  const bool told = elapsed_s > 0.0;
  if (!told) elapsed_s = step_s_ > 0.0 ? step_s_ : kNominalStep_s;

  Prediction prediction{last_, covariance_};
  if (step_s_ > 0.0 && elapsed_s <= config_.max_gap_s) {
    prediction.twist_per_s = (1.0 / step_s_) * step_;
    prediction.map_from_base = last_ * Pose2::exp(elapsed_s * prediction.twist_per_s);
  }
  const double grown_s2 = elapsed_s * elapsed_s;
  const double slack_m = config_.acceleration_mps2 * grown_s2;
  const double slack_rad = config_.turn_acceleration_radps2 * grown_s2;
  prediction.covariance +=
      Eigen::Vector3d(slack_m * slack_m, slack_m * slack_m, slack_rad * slack_rad).asDiagonal();
  return prediction;
}

void MotionFilter::correct(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  if (stamped_) {
    const double elapsed_s = seconds_between(stamp_, stamp);
    step_ = (last_.inverse() * map_from_base).log();
    step_s_ = elapsed_s > 0.0 ? elapsed_s : (step_s_ > 0.0 ? step_s_ : kNominalStep_s);
  }
  last_ = map_from_base;
  covariance_ = covariance;
  stamp_ = stamp;
  stamped_ = true;
}

}  // namespace beaconless
