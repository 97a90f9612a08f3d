// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/recorded_scans.hpp"

#include <optional>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/map/grid_builder.hpp"

namespace beaconless::trust {

RecordedScans read_scans(const RecordedSource& source) {
  io::RecordingOptions options;
  options.topic = source.topic;
  options.gate.stamp_is = source.stamp_is;
  const Trajectory reference = source.truth.empty() ? Trajectory{} : io::read_tum(source.truth).value();
  RecordedScans scans;
  std::optional<ReferencePose> told;
  for (const Event& event : io::open_recording(source.log, options).value()) {
    if (const auto* pose = std::get_if<ReferencePose>(&event)) {
      told = *pose;
    } else if (const auto* scan = std::get_if<Scan>(&event)) {
      std::optional<Pose2> truth;
      if (!source.truth.empty())
        truth = reference.at(scan->stamp());
      else if (told && told->stamp == scan->stamp())
        truth = told->map_from_base;
      told.reset();
      if (!truth) continue;
      scans.events.push_back(event);
      scans.truth.push_back(source.truth_is_of_laser ? *truth * source.base_from_laser.inverse() : *truth);
    } else {
      scans.events.push_back(event);
    }
  }
  return scans;
}

OccupancyGrid grid_of(const RecordedScans& scans, const Pose2& base_from_laser) {
  auto builder = GridBuilder::make().value();
  std::size_t i = 0;
  for (const Event& event : scans.events)
    if (const auto* scan = std::get_if<Scan>(&event))
      builder.add(*scan, scans.truth[i++] * base_from_laser).value();
  return builder.grid();
}

}  // namespace beaconless::trust
