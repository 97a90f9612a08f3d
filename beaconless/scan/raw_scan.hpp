// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/core/stamp.hpp"

namespace beaconless {

/// One sweep as a driver or a file gives it, with all its habits; `Scan::make` turns it into a Scan.
///
/// The fields and their widths are those of sensor_msgs/LaserScan, so that every source passes through the
/// same floats and the same sweep gives the same bits whichever format carried it.
struct RawScan {
  Stamp stamp;  ///< of the first beam (see ScanGate::stamp_is)
  std::string frame_id;
  float angle_min_rad = 0.0F;        ///< bearing of ranges_m[0]
  float angle_increment_rad = 0.0F;  ///< may be negative
  float time_increment_s = 0.0F;     ///< from one beam to the next
  float scan_time_s = 0.0F;          ///< from one sweep to the next
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;        ///< 0: not told
  std::vector<float> ranges_m;     ///< NaN, ±inf, 0 and values beyond range_max_m welcome
  std::vector<float> intensities;  ///< empty, or as many as ranges_m

  friend bool operator==(const RawScan&, const RawScan&) = default;
};

}  // namespace beaconless
