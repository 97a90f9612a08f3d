// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/interest_regions.hpp"
#include "beaconless/features/point_feature.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/localize/health.hpp"
#include "beaconless/localize/place_finder.hpp"
#include "beaconless/map/occupancy_pyramid.hpp"
#include "beaconless/match/feature_icp.hpp"
#include "beaconless/match/feature_map.hpp"
#include "beaconless/match/hector.hpp"
#include "beaconless/match/icp.hpp"
#include "beaconless/match/local_search.hpp"
#include "beaconless/match/walls.hpp"
#include "beaconless/particle/amcl_config.hpp"
#include "beaconless/track/feature_tracker.hpp"
#include "beaconless/track/motion_filter.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// One of several lasers on a robot.
struct LaserOnRobot {
  std::string frame_id;  ///< of its scans, which tells them from those of the others
  Pose2 base_from_laser;
};

/// Everything that shapes a localizer.
struct LocalizerConfig {
  std::string method = "walls";
  Pose2 base_from_laser;             ///< where the laser sits on the robot
  std::vector<LaserOnRobot> lasers;  ///< where there are several: then base_from_laser is not asked for
  bool deskew = true;  ///< see each beam from where the laser was, where the source tells beams' times
  WallsConfig walls;
  IcpConfig icp;
  PointFeaturesConfig features;   ///< how the feature methods find features …
  FeatureMapConfig feature_map;   ///< … in the map
  FeatureIcpConfig feature_icp;   ///< … and pair both
  FeatureTrackerConfig tracking;  ///< of the methods that remember features
  InterestRegionsConfig regions;  ///< of `hector-regions`
  PyramidConfig pyramid;
  HectorConfig hector;
  LocalSearchConfig search;
  PlacesConfig places;     ///< how a robot is found that may be anywhere …
  bool relocalize = true;  ///< … and that it is, when it is lost
  MotionConfig motion;
  OdometryConfig odometry;
  HealthConfig health;
  AmclConfig amcl;
};

void describe(Fields& fields, LocalizerConfig& config);

/// Where the laser sits that a scan comes from.
const Pose2& base_from_laser_of(const LocalizerConfig& config, std::string_view frame_id);

}  // namespace beaconless
