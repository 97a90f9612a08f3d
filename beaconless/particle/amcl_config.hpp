// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"

namespace beaconless {

/// How wheels err.
enum class OdometryModel : int {
  diff,            ///< two turns and a way between; ROS's bug kept: variances serve as standard deviations
  diff_corrected,  ///< the same with the square root taken
  omni,            ///< a way in any direction and a turn; the same bug kept
  omni_corrected,  ///< the same with the square root taken
};

/// How a scan weighs a pose.
enum class LaserModel : int {
  likelihood_field,       ///< 1 + the sum of p³ over the ends of beams, a heuristic
  likelihood_field_prob,  ///< the product of p, tempered
  beam,                   ///< the product of p of whole beams that are cast through the map, tempered
};

/// Everything that shapes a particle filter, under the names that it has in ROS's amcl (m, rad).
///
/// Differs from ROS's defaults: 60 beams instead of 30; `laser_model_type` is likelihood_field_prob, because
/// the sum of p³ is no likelihood and its mean hardly moves when the robot is lost; `odom_model_type` is
/// diff-corrected, and with it the alphas are 0.01, since 0.2 suits the square of what it is taken for;
/// `kld_err` and `kld_z` are 0.05 and 2.326 (99 %) where ROS has 0.99, a probability, for a quantile;
/// resampling is selective and may happen at every update.
struct AmclConfig {
  int seed = 1;
  int min_particles = 1000;
  int max_particles = 5000;
  double kld_err = 0.05;
  double kld_z = 2.326;
  double update_min_d = 0.2;  ///< the robot moves so far, or turns as below, from one update to the next
  double update_min_a = 0.5235987755982988;
  int resample_interval = 1;  ///< updates
  bool selective_resampling = true;
  double recovery_alpha_slow = 0.001;
  double recovery_alpha_fast = 0.1;

  OdometryModel odom_model_type = OdometryModel::diff_corrected;
  double odom_alpha1 = 0.01;
  double odom_alpha2 = 0.01;
  double odom_alpha3 = 0.01;
  double odom_alpha4 = 0.01;
  double odom_alpha5 = 0.01;

  LaserModel laser_model_type = LaserModel::likelihood_field_prob;
  int laser_max_beams = 60;
  double laser_max_range = 30.0;  ///< over which random ranges are spread; ROS: the scan's own
  double laser_z_hit = 0.95;
  double laser_z_short = 0.1;
  double laser_z_max = 0.05;
  double laser_z_rand = 0.05;
  double laser_sigma_hit = 0.2;
  double laser_lambda_short = 0.1;
  double laser_likelihood_max_dist = 2.0;
  bool do_beamskip = false;
  double beam_skip_distance = 0.5;
  double beam_skip_threshold = 0.3;
  double beam_skip_error_threshold = 0.9;

  // Not in ROS's amcl.
  double laser_independent_beams =
      8.0;  ///< what the beams used are worth: errors of neighbours, and of the map, go along
  double laser_field_cell = 0.05;       ///< of the likelihood field
  double least_effective_ratio = 0.05;  ///< a scan that leaves fewer effective particles is tempered more
  double still_sigma_m = 0.003;         ///< without odometry a cloud spreads by this from scan to scan …
  double still_sigma_rad = 0.003;       ///< … and this at least
  double on_map_m = 0.2;                ///< a point this near to a wall counts as explained by the map
};

void describe(Fields& fields, AmclConfig& config);

}  // namespace beaconless
