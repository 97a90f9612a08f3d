// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/amcl_config.hpp"

namespace beaconless {
namespace {

constexpr Range kShare{0.0, 1.0};
constexpr Range kLength{1e-3, 1e3};
constexpr Range kCount{1, 1e6};

void describe_filter(Fields& fields, AmclConfig& config) {
  fields("seed", config.seed, {0, 2147483647}, "of all that is drawn; the same gives the same bits");
  fields("min_particles", config.min_particles, kCount, "however sure the pose is");
  fields("max_particles", config.max_particles, kCount, "however unsure it is, and at a start anywhere");
  fields("kld_err", config.kld_err, {1e-4, 1.0},
         "how far the particles may be from what they stand for (Kullback-Leibler)");
  fields("kld_z", config.kld_z, {0.0, 10.0}, "quantile of how surely: 2.326 is 99 %");
  fields("update_min_d", config.update_min_d, {0.0, 100.0},
         "with odometry, an update is due when the robot has moved so far (m)");
  fields("update_min_a", config.update_min_a, {0.0, 7.0}, "or turned so far (rad)");
  fields("resample_interval", config.resample_interval, {1, 1000}, "updates from one drawing to the next");
  fields("selective_resampling", config.selective_resampling,
         "draws only where fewer than half of the particles are effective");
  fields("recovery_alpha_slow", config.recovery_alpha_slow, kShare,
         "how fast the long mean of weights follows; 0: no recovery");
  fields("recovery_alpha_fast", config.recovery_alpha_fast, kShare,
         "how fast the short mean follows; below the long one particles are put anywhere");
}

void describe_motion(Fields& fields, AmclConfig& config) {
  fields("odom_model_type", config.odom_model_type, {"diff", "diff-corrected", "omni", "omni-corrected"},
         "how wheels err; diff and omni keep ROS's variances for standard deviations");
  fields("odom_alpha1", config.odom_alpha1, {0.0, 100.0}, "variance of a turn by the turn (rad²/rad²)");
  fields("odom_alpha2", config.odom_alpha2, {0.0, 100.0}, "variance of a turn by the way (rad²/m²)");
  fields("odom_alpha3", config.odom_alpha3, {0.0, 100.0}, "variance of a way by the way (m²/m²)");
  fields("odom_alpha4", config.odom_alpha4, {0.0, 100.0},
         "variance of a way by the turn (m²/rad²); omni: of a turn by the turn");
  fields("odom_alpha5", config.odom_alpha5, {0.0, 100.0}, "omni: variance to the side by the way (m²/m²)");
  fields("still_sigma_m", config.still_sigma_m, {0.0, 1.0},
         "without odometry the particles spread by this from scan to scan (m)");
  fields("still_sigma_rad", config.still_sigma_rad, {0.0, 1.0}, "and their headings (rad)");
}

void describe_laser(Fields& fields, AmclConfig& config) {
  fields("laser_model_type", config.laser_model_type, {"likelihood_field", "likelihood_field_prob", "beam"},
         "how a scan weighs a pose");
  fields("laser_max_beams", config.laser_max_beams, {1, 100000}, "beams that weigh, evenly taken");
  fields("laser_max_range", config.laser_max_range, kLength, "over which random ranges are spread (m)");
  fields("laser_z_hit", config.laser_z_hit, kShare, "share of beams that end at a wall");
  fields("laser_z_short", config.laser_z_short, kShare, "beam: share that something unknown shortens");
  fields("laser_z_max", config.laser_z_max, kShare, "beam: share without a return");
  fields("laser_z_rand", config.laser_z_rand, kShare, "share that ends anywhere");
  fields("laser_sigma_hit", config.laser_sigma_hit, {1e-3, 10.0}, "how far ends are from the wall (m)");
  fields("laser_lambda_short", config.laser_lambda_short, {1e-6, 100.0}, "beam: rate of what shortens (1/m)");
  fields("laser_likelihood_max_dist", config.laser_likelihood_max_dist, {0.05, 100.0},
         "from a wall, beyond which all is alike (m)");
  fields("laser_independent_beams", config.laser_independent_beams, {1.0, 1e6},
         "so many independent beams are those taken worth");
  fields("laser_field_cell", config.laser_field_cell, {0.005, 1.0}, "cells of the likelihood field (m)");
  fields("least_effective_ratio", config.least_effective_ratio, {0.0, 0.5},
         "share of the particles that a scan leaves effective at least");
  fields("do_beamskip", config.do_beamskip,
         "likelihood_field_prob: beams that few particles explain do not weigh");
  fields("beam_skip_distance", config.beam_skip_distance, kLength, "from a wall, that still explains (m)");
  fields("beam_skip_threshold", config.beam_skip_threshold, kShare, "particles that explain a beam kept");
  fields("beam_skip_error_threshold", config.beam_skip_error_threshold, kShare,
         "where more beams would be left out all are kept");
  fields("on_map_m", config.on_map_m, kLength, "a point this near to a wall is explained by the map");
}

}  // namespace

void describe(Fields& fields, AmclConfig& config) {
  describe_filter(fields, config);
  describe_motion(fields, config);
  describe_laser(fields, config);
}

}  // namespace beaconless
