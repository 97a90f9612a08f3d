// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/hector_slam_config.hpp"

namespace beaconless {

void describe(Fields& fields, HectorSlamConfig& config) {
  fields("base_from_laser.x_m", config.base_from_laser.x_m, {-100.0, 100.0},
         "the laser's place ahead of the base");
  fields("base_from_laser.y_m", config.base_from_laser.y_m, {-100.0, 100.0}, "the laser's place to the left");
  fields("base_from_laser.theta_rad", config.base_from_laser.theta_rad, {-7.0, 7.0}, "the laser's heading");
  fields.section("map", config.map);
  fields("max_range_m", config.beams.max_range_m, {0.1, 1000.0},
         "hits beyond it are not matched, and only free the way up to it");
  fields("no_return_free_m", config.beams.no_return_free_m, {0.0, 1000.0},
         "beams without return free the way up to here; 0: they say nothing");
  fields("update_distance_m", config.update_distance_m, {0.0, 1000.0},
         "a scan is drawn when the robot has moved so far since the last that was …");
  fields("update_angle_rad", config.update_angle_rad, {0.0, 7.0}, "… or turned so much");
  fields("guess", config.guess, {"last_pose", "constant_velocity", "odometry"},
         "from where a scan's match starts");
  fields.section("motion", config.motion, {"start_sigma_m", "start_sigma_deg"});
  fields.section("match", config.match);
  fields("search_when", config.search_when, {"never", "in_doubt", "always"},
         "when the poses around the guess are searched");
  fields.section("search", config.search);
  fields("speed_mps", config.speed_mps, {0.0, 100.0},
         "how much faster or slower than predicted a robot may be; so far it is searched");
  fields("turn_degps", config.turn_degps, {0.0, 10000.0}, "how much faster or slower it may turn");
  fields.section("judge", config.judge);
  fields("lost_after_scans", config.lost_after_scans, {1, 100000},
         "so many scans in a row that are not held mean lost");
}

}  // namespace beaconless
