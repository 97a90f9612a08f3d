// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/amcl_names.hpp"

#include <algorithm>
#include <array>

namespace beaconless::ros1 {
namespace {

constexpr std::string_view kNoThrottle = "poses, beams and places are sent with each scan";

// Frames, start pose and the laser's limits are not here: the node has them under the same names.
constexpr std::array kNames{
    AmclName{"min_particles", "amcl.min_particles", ""},
    AmclName{"max_particles", "amcl.max_particles", ""},
    AmclName{"kld_err", "amcl.kld_err", ""},
    AmclName{"kld_z", "amcl.kld_z", ""},
    AmclName{"update_min_d", "amcl.update_min_d", ""},
    AmclName{"update_min_a", "amcl.update_min_a", ""},
    AmclName{"resample_interval", "amcl.resample_interval", ""},
    AmclName{"selective_resampling", "amcl.selective_resampling", ""},
    AmclName{"recovery_alpha_slow", "amcl.recovery_alpha_slow", ""},
    AmclName{"recovery_alpha_fast", "amcl.recovery_alpha_fast", ""},
    AmclName{"odom_model_type", "amcl.odom_model_type", ""},
    AmclName{"odom_alpha1", "amcl.odom_alpha1", ""},
    AmclName{"odom_alpha2", "amcl.odom_alpha2", ""},
    AmclName{"odom_alpha3", "amcl.odom_alpha3", ""},
    AmclName{"odom_alpha4", "amcl.odom_alpha4", ""},
    AmclName{"odom_alpha5", "amcl.odom_alpha5", ""},
    AmclName{"laser_model_type", "amcl.laser_model_type", ""},
    AmclName{"laser_max_beams", "amcl.laser_max_beams", ""},
    AmclName{"laser_z_hit", "amcl.laser_z_hit", ""},
    AmclName{"laser_z_short", "amcl.laser_z_short", ""},
    AmclName{"laser_z_max", "amcl.laser_z_max", ""},
    AmclName{"laser_z_rand", "amcl.laser_z_rand", ""},
    AmclName{"laser_sigma_hit", "amcl.laser_sigma_hit", ""},
    AmclName{"laser_lambda_short", "amcl.laser_lambda_short", ""},
    AmclName{"laser_likelihood_max_dist", "amcl.laser_likelihood_max_dist", ""},
    AmclName{"do_beamskip", "amcl.do_beamskip", ""},
    AmclName{"beam_skip_distance", "amcl.beam_skip_distance", ""},
    AmclName{"beam_skip_threshold", "amcl.beam_skip_threshold", ""},
    AmclName{"beam_skip_error_threshold", "amcl.beam_skip_error_threshold", ""},
    AmclName{"gui_publish_rate", "", kNoThrottle},
    AmclName{"save_pose_rate", "", "the service save_pose and pose_file keep the pose"},
    AmclName{"use_map_topic", "", "the topic map is always listened to, unless map_file is given"},
    AmclName{"restore_defaults", "", "there is no dynamic_reconfigure"},
    AmclName{"force_update_after_initialpose", "", "every scan is an update"},
    AmclName{"force_update_after_set_map", "", "every scan is an update"},
    AmclName{"std_warn_level_x", "", "the status and the protection level in /diagnostics tell"},
    AmclName{"std_warn_level_y", "", "the status and the protection level in /diagnostics tell"},
    AmclName{"std_warn_level_yaw", "", "the status and the protection level in /diagnostics tell"},
    AmclName{"bag_scan_period", "", "recordings are localized by `beaconless localize`"},
};

}  // namespace

std::span<const AmclName> amcl_names() { return kNames; }

std::optional<AmclName> amcl_name(std::string_view name) {
  const auto* const known =
      std::find_if(kNames.begin(), kNames.end(), [&](const AmclName& of) { return of.name == name; });
  return known == kNames.end() ? std::nullopt : std::optional(*known);
}

}  // namespace beaconless::ros1
