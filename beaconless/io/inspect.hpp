// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// The odometry or the reference poses of one source (a topic, a keyword).
struct PoseSource {
  std::string name;
  std::uint64_t count = 0;
  double path_length_m = 0.0;
  std::uint64_t jumps = 0;               ///< faster than 5 m/s or 10 rad/s from one reading to the next
  std::uint64_t moves_without_time = 0;  ///< another place, 1 cm or more away, under the same stamp

  std::optional<Pose2> base_from_laser;  ///< the median, where the source tells laser and robot pose apart
  bool is_base_from_laser_constant = false;  ///< nineteen of twenty within 2 cm and 1 degree of it
};

/// What one pass over a recording shows. Counts of beams are over all scans.
struct RecordingSummary {
  std::string path;
  std::string format;
  std::string scan_topic;
  std::vector<Topic> topics;
  std::optional<LaserPlace> laser_place;  ///< as the recording tells it once and for all
  std::uint64_t skipped_records = 0;

  std::uint64_t scans = 0;
  Stamp first_stamp;
  Stamp last_stamp;  ///< the latest one
  double duration_s = 0.0;
  double rate_hz = 0.0;  ///< one over the median interval of the scans; 0 where that is 0
  double longest_gap_s = 0.0;
  std::uint64_t gaps = 0;  ///< intervals of more than a second and five median ones
  std::uint64_t repeated_stamps = 0;
  std::uint64_t backward_stamps = 0;

  std::size_t least_beams = 0;
  std::size_t most_beams = 0;
  std::string frame_id;  ///< this and the next six are the first scan's
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double field_of_view_rad = 0.0;  ///< from the first beam to the last
  double range_min_m = 0.0;
  double range_max_m = 0.0;       ///< infinity when not told
  bool tells_beam_times = false;  ///< some scan has a time per beam

  std::uint64_t hits = 0;
  std::uint64_t no_returns = 0;
  std::uint64_t too_close = 0;
  std::uint64_t invalid = 0;
  double longest_hit_m = 0.0;
  std::optional<double> capped_at_m;  ///< a range that stands for "nothing seen" although it looks like a hit
  double capped_share = 0.0;          ///< of all beams

  std::vector<PoseSource> odometry;
  std::vector<PoseSource> references;

  std::uint64_t beams() const { return hits + no_returns + too_close + invalid; }
  double share(std::uint64_t count) const {
    return beams() == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(beams());
  }
};

/// Reads the whole recording once, with memory that does not grow with it.
RecordingSummary summarize(const Recording& recording);

/// Something a user should know about a recording, in words.
struct Finding {
  enum class Weight { note, warning };

  Weight weight = Weight::note;
  std::string what;
  std::string remedy;  ///< what to do about it; may be empty
};

/// What is unusual or wrong with a recording and what to do about it, warnings first; empty when nothing is.
std::vector<Finding> diagnose(const RecordingSummary& summary);

}  // namespace beaconless::io
