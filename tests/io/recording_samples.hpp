// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless {

/// Sweeps with every habit a sensor has: all kinds of missing ranges, times, intensities, a frame.
inline std::vector<RawScan> sample_scans(std::size_t count, std::size_t beams, std::uint64_t seed = 1) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Rng rng(seed);
  std::vector<RawScan> scans;
  for (std::size_t i = 0; i < count; ++i) {
    RawScan scan;
    scan.stamp.ns = 1'411'657'682'042'859'022 + static_cast<std::int64_t>(i) * 25'000'001;
    scan.frame_id = "base_laser_link";
    scan.angle_min_rad = -2.35619449F;
    scan.angle_increment_rad = 0.00436332F;
    scan.time_increment_s = 1.7361111e-05F;
    scan.scan_time_s = 0.025F;
    scan.range_min_m = 0.1F;
    scan.range_max_m = 30.0F;
    for (std::size_t beam = 0; beam < beams; ++beam) {
      scan.ranges_m.push_back(static_cast<float>(rng.uniform(0.05, 31.0)));
      scan.intensities.push_back(static_cast<float>(rng.uniform(0.0, 4000.0)));
    }
    if (beams > 10) {
      const float odd[] = {kInf, -kInf, std::nanf(""), 0.0F, -1.0F, 1e-45F, 3.4e38F, 65.533F};
      for (std::size_t k = 0; k < 8; ++k) scan.ranges_m[(i + k) % beams] = odd[k];
    }
    scans.push_back(scan);
  }
  return scans;
}

/// Where to cut a file of so many bytes: at some 200 places all over it, and at each of its last bytes.
inline std::vector<std::size_t> cuts(std::size_t size) {
  constexpr std::size_t kSpread = 200;
  constexpr std::size_t kLast = 70;
  const std::size_t tail = size - std::min(size, kLast);
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < tail; at += std::max<std::size_t>(1, size / kSpread)) places.push_back(at);
  for (std::size_t at = tail; at < size; ++at) places.push_back(at);
  return places;
}

/// Everything a pass over a recording gives, or why it could not be opened.
struct Pass {
  std::optional<Error> error;
  std::vector<Event> events;
  std::vector<Scan> scans;
  std::vector<Odometry> odometry;
  std::vector<ReferencePose> references;
  std::vector<io::Problem> problems;
};

inline Pass pass_over(const std::string& path, io::RecordingOptions options = {}) {
  Pass pass;
  options.on_problem = [&](const io::Problem& problem) { pass.problems.push_back(problem); };
  const auto recording = io::open_recording(path, options);
  if (!recording) {
    pass.error = recording.error();
    return pass;
  }
  for (const Event& event : *recording) {
    pass.events.push_back(event);
    if (const auto* scan = std::get_if<Scan>(&event)) pass.scans.push_back(*scan);
    if (const auto* odometry = std::get_if<Odometry>(&event)) pass.odometry.push_back(*odometry);
    if (const auto* reference = std::get_if<ReferencePose>(&event)) pass.references.push_back(*reference);
  }
  return pass;
}

}  // namespace beaconless
