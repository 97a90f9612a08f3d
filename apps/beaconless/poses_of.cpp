// SPDX-License-Identifier: Apache-2.0
#include "poses_of.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/core/suggest.hpp"
#include "beaconless/io/tum.hpp"

namespace beaconless::cli {
namespace {

/// What one source inside a recording said.
struct Source {
  bool is_reference = false;
  std::vector<StampedPose> poses;
  std::vector<std::optional<Pose2>> by_scan;
  std::optional<Pose2> base_from_laser;
};

using Sources = std::map<std::string, Source>;

Sources gather(const io::Recording& recording) {
  Sources sources;
  std::size_t scan_count = 0;
  std::optional<ReferencePose> last_reference;
  for (const Event& event : recording) {
    if (const auto* odometry = std::get_if<Odometry>(&event)) {
      sources[odometry->source].poses.push_back({odometry->stamp, odometry->odom_from_base});
    } else if (const auto* reference = std::get_if<ReferencePose>(&event)) {
      Source& source = sources[reference->source];
      source.is_reference = true;
      source.poses.push_back({reference->stamp, reference->map_from_base});
      if (reference->base_from_laser) source.base_from_laser = reference->base_from_laser;
      last_reference = *reference;
      continue;
    } else if (last_reference && last_reference->stamp == stamp_of(event)) {
      // A log's scan line gives the pose right before its scan.
      auto& by_scan = sources[last_reference->source].by_scan;
      by_scan.resize(scan_count + 1);
      by_scan[scan_count] = last_reference->map_from_base;
    }
    if (std::holds_alternative<Scan>(event)) ++scan_count;
    last_reference.reset();
  }
  return sources;
}

std::string names_of(const Sources& sources) {
  std::string names;
  for (const auto& [name, source] : sources)
    names += (names.empty() ? "" : ", ") + name + " (" + std::to_string(source.poses.size()) + ")";
  return names.empty() ? "none" : names;
}

/// The source that is meant, or why there is none.
Result<std::string> choose(const Sources& sources, const io::Recording& recording, const std::string& topic) {
  if (!topic.empty() && !sources.contains(topic))
    return Error{recording.path(), "there are no poses under \"" + topic + "\"",
                 "there are: " + names_of(sources)};
  if (!topic.empty()) return topic;
  if (sources.contains(recording.scan_topic())) return recording.scan_topic();
  for (const bool want_reference : {true, false}) {
    std::vector<std::string> fitting;
    for (const auto& [name, source] : sources)
      if (source.is_reference == want_reference) fitting.push_back(name);
    if (fitting.size() == 1) return fitting.front();
    if (fitting.size() > 1)
      return Error{recording.path(), "there are several sources of poses",
                   "choose one of: " + names_of(sources)};
  }
  return Error{recording.path(), "the recording carries no poses", "give a TUM file"};
}

}  // namespace

bool PosesOf::tells_laser_apart() const {
  constexpr double kNoticeable_m = 0.01;
  return base_from_laser && std::hypot(base_from_laser->x_m, base_from_laser->y_m) > kNoticeable_m;
}

std::optional<Pose2> PosesOf::at(std::size_t scan_index, Stamp stamp) const {
  if (scan_index < by_scan.size() && by_scan[scan_index]) return by_scan[scan_index];
  return trajectory.at(stamp);
}

Result<PosesOf> poses_of(const std::string& tum_or_recorded, const io::Recording& recording,
                         const std::string& topic, ProblemLog& problems) {
  PosesOf poses;
  if (const auto& told = recording.laser_place()) poses.base_from_laser = told->base_from_laser;
  if (tum_or_recorded != "recorded") {
    auto trajectory = io::read_tum(tum_or_recorded, [&](const io::Problem& p) { problems.add(p); });
    if (!trajectory) return trajectory.error();
    poses.source = tum_or_recorded;
    poses.trajectory = *trajectory;
    return poses;
  }
  Sources sources = gather(recording);
  const auto chosen = choose(sources, recording, topic);
  if (!chosen) return chosen.error();
  Source& source = sources[*chosen];
  poses.source = *chosen;
  poses.trajectory = Trajectory(std::move(source.poses));
  poses.by_scan = std::move(source.by_scan);
  if (source.base_from_laser) poses.base_from_laser = source.base_from_laser;
  return poses;
}

}  // namespace beaconless::cli
