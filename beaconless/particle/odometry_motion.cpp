// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/odometry_motion.hpp"

#include <cmath>

namespace beaconless {
namespace {

constexpr double kNoDirection_m = 0.01;  // of a shorter way rounding tells as much as the wheels

double square(double value) { return value * value; }

}  // namespace

OdometryStep odometry_step(const Pose2& motion, const AmclConfig& config) {
  const OdometryModel model = config.odom_model_type;
  const bool is_rooted = model == OdometryModel::diff_corrected || model == OdometryModel::omni_corrected;
  const auto sigma = [&](double variance) { return is_rooted ? std::sqrt(variance) : variance; };
  OdometryStep step;
  step.is_omni = model == OdometryModel::omni || model == OdometryModel::omni_corrected;
  step.way_m = std::hypot(motion.x_m, motion.y_m);
  const double direction = step.way_m > 0.0 ? std::atan2(motion.y_m, motion.x_m) : 0.0;
  const double turn = wrap_angle(motion.theta_rad);
  const double way2 = square(step.way_m);
  if (step.is_omni) {
    step.turn1_rad = direction;
    step.turn2_rad = turn;
    step.way_sigma_m = sigma(config.odom_alpha3 * way2 + config.odom_alpha1 * square(turn));
    step.turn2_sigma_rad = sigma(config.odom_alpha4 * square(turn) + config.odom_alpha2 * way2);
    step.side_sigma_m = sigma(config.odom_alpha1 * square(turn) + config.odom_alpha5 * way2);
    return step;
  }
  if (step.way_m >= kNoDirection_m) {
    const bool is_backwards = std::abs(direction) > 0.5 * kPi;
    step.turn1_rad = is_backwards ? wrap_angle(direction - kPi) : direction;
    if (is_backwards) step.way_m = -step.way_m;
  } else {
    step.way_m = motion.x_m;
  }
  step.turn2_rad = wrap_angle(turn - step.turn1_rad);
  const double first2 = square(step.turn1_rad);
  const double second2 = square(step.turn2_rad);
  step.turn1_sigma_rad = sigma(config.odom_alpha1 * first2 + config.odom_alpha2 * way2);
  step.way_sigma_m = sigma(config.odom_alpha3 * way2 + config.odom_alpha4 * (first2 + second2));
  step.turn2_sigma_rad = sigma(config.odom_alpha1 * second2 + config.odom_alpha2 * way2);
  return step;
}

void move_by_odometry(const OdometryStep& step, Rng& rng, Particles& particles) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double way = step.way_m + rng.normal(step.way_sigma_m);
    const double turn2 = step.turn2_rad + rng.normal(step.turn2_sigma_rad);
    const double third = rng.normal();
    const double turn1 = step.turn1_rad + third * step.turn1_sigma_rad;
    const double side = third * step.side_sigma_m;
    double& theta = particles.theta_rad[i];
    const double c = std::cos(theta + turn1);
    const double s = std::sin(theta + turn1);
    particles.x_m[i] += way * c - side * s;
    particles.y_m[i] += way * s + side * c;
    theta = wrap_heading(theta + turn2 + (step.is_omni ? 0.0 : turn1));
  }
}

Eigen::Matrix3d moved_by_odometry(const Eigen::Matrix3d& covariance, const Pose2& map_from_base,
                                  const OdometryStep& step) {
  const double heading = map_from_base.theta_rad + step.turn1_rad;
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose.topRightCorner<2, 1>() = step.way_m * across;
  Eigen::Matrix<double, 3, 4> by_noise = Eigen::Matrix<double, 3, 4>::Zero();  // way, turn1, turn2, side
  by_noise.col(0).head<2>() = step.way_sigma_m * along;
  by_noise.col(1) << step.turn1_sigma_rad * step.way_m * across, step.turn1_sigma_rad;
  by_noise(2, 2) = step.turn2_sigma_rad;
  by_noise.col(3).head<2>() = step.side_sigma_m * across;
  return by_pose * covariance * by_pose.transpose() + by_noise * by_noise.transpose();
}

}  // namespace beaconless
