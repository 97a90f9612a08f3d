// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/hector.hpp"
#include "beaconless/slam/fit_judge.hpp"
#include "beaconless/slam/growing_map.hpp"
#include "beaconless/slam/pyramid_search.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// From where a scan's match starts.
enum class SlamGuess : int {
  last_pose,          ///< as HectorSLAM does
  constant_velocity,  ///< the robot goes on as it went
  odometry,           ///< the last pose, moved as the wheels say; constant velocity until they say something
};

/// When the poses around the guess are searched.
enum class SlamSearch : int {
  never,
  in_doubt,  ///< where the match explains less of the scan than is usual
  always,
};

/// Everything that shapes a run of HectorSlam.
struct HectorSlamConfig {
  Pose2 base_from_laser;  ///< where the laser sits on the robot
  GrowingMapConfig map;
  BeamReach beams;                 ///< how far beams are believed, to be matched and to be drawn
  double update_distance_m = 0.4;  ///< a scan is drawn when the robot has moved so far since the last one …
  double update_angle_rad = 0.13;  ///< … or turned so much; Hector's
  SlamGuess guess = SlamGuess::constant_velocity;
  MotionConfig motion;
  /// A direction is held at the prediction only where next to nothing holds it: there is no map to come back
  /// to from where a wrong prediction leads.
  HectorConfig match{.least_share = 0.005};
  SlamSearch search_when = SlamSearch::in_doubt;
  PyramidSearchConfig search;  ///< its window is the least; a robot may be further after a while
  double speed_mps = 1.5;      ///< how much faster or slower than predicted a robot may be
  double turn_degps = 115.0;   ///< … and turn
  FitJudgeConfig judge;
  int lost_after_scans = 10;  ///< so many scans in a row that are not held, and the robot is lost
};

void describe(Fields& fields, HectorSlamConfig& config);

}  // namespace beaconless
