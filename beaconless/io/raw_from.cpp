// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/raw_from.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beaconless::io {

RawScan raw_from(const Scan& scan) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  RawScan raw;
  raw.stamp = scan.stamp();
  raw.frame_id = scan.frame_id();
  raw.angle_min_rad = static_cast<float>(scan.angle_min_rad());
  raw.angle_increment_rad = static_cast<float>(scan.angle_increment_rad());
  raw.scan_time_s = static_cast<float>(scan.scan_time_s());
  raw.range_min_m = static_cast<float>(scan.range_min_m());
  raw.range_max_m = std::isfinite(scan.range_max_m()) ? static_cast<float>(scan.range_max_m()) : 0.0F;
  raw.ranges_m.assign(scan.ranges_m().begin(), scan.ranges_m().end());
  raw.intensities.assign(scan.intensities().begin(), scan.intensities().end());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.beams()[i] == Beam::no_return) raw.ranges_m[i] = kInf;
    if (scan.beams()[i] == Beam::too_close) raw.ranges_m[i] = -kInf;
    if (scan.beams()[i] == Beam::invalid) raw.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  if (scan.size() < 2) return raw;
  raw.time_increment_s = static_cast<float>(scan.beam_time_s(1) - scan.beam_time_s(0));
  if (raw.time_increment_s < 0.0F) {  // the sweep ran clockwise: its first beam in time is the last here
    raw.time_increment_s = -raw.time_increment_s;
    raw.angle_min_rad += static_cast<float>(scan.size() - 1) * raw.angle_increment_rad;
    raw.angle_increment_rad = -raw.angle_increment_rad;
    std::reverse(raw.ranges_m.begin(), raw.ranges_m.end());
    std::reverse(raw.intensities.begin(), raw.intensities.end());
  }
  return raw;
}

}  // namespace beaconless::io
