// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// What the PARAM lines of a log have said so far about its lasers.
///
/// `beaconless_laser_…` are our own: they carry what a LaserScan has and a CARMEN line has no room for.
struct CarmenParams {
  float front_max_m = 81.0F;  ///< SICK LMS: 81.83 and above are error codes and mean no return
  float rear_max_m = 81.0F;
  float range_min_m = 0.0F;
  float time_increment_s = 0.0F;
  float scan_time_s = 0.0F;
  std::string frame_id;
  std::optional<Pose2> base_from_laser;  ///< in a log that was written from a recording that tells it

  /// Takes a line `PARAM name value …`; names that are not about lasers are none of ours.
  void take(std::string_view line);
};

/// One laser line: the sweep, and where the line says that laser and robot were.
struct CarmenScan {
  RawScan raw;
  std::optional<Pose2> map_from_laser;
  std::optional<Pose2> map_from_base;
};

/// Whether a line that begins with this word carries a sweep.
bool is_carmen_scan(std::string_view keyword);

/// Reads `FLASER`, `RLASER`, `RAWLASER1…4`, `ROBOTLASER0…4`, or GMapping's `LASER_READING`.
///
/// Errors (without path and line): a count that the line does not hold, a range that is no number, no usable
/// stamp. FLASER and its like tell no angles; they follow from the count of beams, as CARMEN did: 180° for
/// SICK's 180/181 and 360/361, 100° for 101, 201 and 401. An even count over 180° lacks the last beam.
/// Source: CARMEN's logger format, carmen.sourceforge.net/logger_playback.html.
Result<CarmenScan> parse_carmen_scan(std::string_view line, const CarmenParams& params);

/// Reads `ODOM x y theta tv rv accel stamp host logger_stamp`; velocities that are all zero count as not
/// told.
Result<Odometry> parse_carmen_odometry(std::string_view line);

/// Reads `TRUEPOS x y theta odom_x odom_y odom_theta stamp host logger_stamp`.
Result<ReferencePose> parse_carmen_true_pose(std::string_view line);

/// A frame name as one word of a PARAM line (blanks and % become %XX), and back.
std::string to_carmen_word(std::string_view frame_id);
std::string from_carmen_word(std::string_view word);

}  // namespace beaconless::io
