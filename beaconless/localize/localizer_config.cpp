// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/localizer_config.hpp"

#include <algorithm>

#include "beaconless/localize/make_localizer.hpp"

namespace beaconless {

const Pose2& base_from_laser_of(const LocalizerConfig& config, std::string_view frame_id) {
  const auto laser = std::find_if(config.lasers.begin(), config.lasers.end(),
                                  [&](const LaserOnRobot& of) { return of.frame_id == frame_id; });
  return laser == config.lasers.end() ? config.base_from_laser : laser->base_from_laser;
}

void describe(Fields& fields, LocalizerConfig& config) {
  Words names;
  names.reserve(methods().size());
  for (const Method& method : methods()) names.push_back(method.name);
  fields("method", config.method, names, "how a pose is found");
  fields("base_from_laser.x_m", config.base_from_laser.x_m, {-100.0, 100.0},
         "the laser's place ahead of the base");
  fields("base_from_laser.y_m", config.base_from_laser.y_m, {-100.0, 100.0}, "the laser's place to the left");
  fields("base_from_laser.theta_rad", config.base_from_laser.theta_rad, {-7.0, 7.0}, "the laser's heading");
  fields("deskew", config.deskew, "each beam is seen from where the laser was then, by the robot's motion");
  fields.section("walls", config.walls);
  fields.section("icp", config.icp);
  fields.section("feature_icp", config.feature_icp);
  fields.section("feature_map", config.feature_map);
  fields.section("tracking", config.tracking);
  fields.section("pyramid", config.pyramid);
  fields.section("hector", config.hector);
  fields.section("regions", config.regions);
  fields.section("search", config.search);
  fields.section("places", config.places);
  fields("relocalize", config.relocalize, "a robot that is lost is looked for on the whole map");
  fields.section("motion", config.motion);
  fields.section("odometry", config.odometry);
  fields.section("health", config.health);
  fields.section("amcl", config.amcl);
  fields.section("features", config.features);
}

}  // namespace beaconless
