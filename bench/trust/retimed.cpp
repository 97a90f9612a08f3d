// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/retimed.hpp"

#include <algorithm>
#include <limits>

namespace beaconless::trust {
namespace {

/// The range by which the gate knows what became of a beam.
float told_range_m(const Scan& scan, std::size_t beam) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  switch (scan.beams()[beam]) {
    case Beam::hit:
      return scan.ranges_m()[beam];
    case Beam::no_return:
      return kInfinity;
    case Beam::too_close:
      return -kInfinity;
    case Beam::invalid:
      break;
  }
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Scan retimed(const Scan& scan, Stamp stamp) {
  const std::size_t last = scan.size() - 1;
  const bool is_clockwise = scan.beam_time_s(last) < scan.beam_time_s(0);
  RawScan raw{.stamp = stamp, .frame_id = scan.frame_id()};
  raw.angle_min_rad = static_cast<float>(scan.angle_rad(is_clockwise ? last : 0));
  raw.angle_increment_rad = static_cast<float>((is_clockwise ? -1.0 : 1.0) * scan.angle_increment_rad());
  raw.time_increment_s =
      static_cast<float>(scan.sweep_time_s() / static_cast<double>(std::max<std::size_t>(1, last)));
  raw.scan_time_s = static_cast<float>(scan.scan_time_s());
  raw.range_min_m = static_cast<float>(scan.range_min_m());
  raw.range_max_m = std::isfinite(scan.range_max_m()) ? static_cast<float>(scan.range_max_m()) : 0.0F;
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    raw.ranges_m.push_back(told_range_m(scan, is_clockwise ? last - beam : beam));
  return Scan::make(std::move(raw)).value();
}

}  // namespace beaconless::trust
