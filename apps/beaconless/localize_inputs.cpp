// SPDX-License-Identifier: Apache-2.0
#include "localize_inputs.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"

#include "laser_set.hpp"
#include "region_on_map.hpp"

namespace beaconless::cli {
namespace {

Result<FirstScan> first_scan(const io::Recording& recording, const io::ScanSelection& scans) {
  std::size_t index = 0;
  for (const Event& event : recording) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    if (scans.wants(index)) return FirstScan{index, *scan};
    if (scans.done_after(index++)) break;
  }
  return Error{recording.path(), "no scan to localize",
               index == 0 ? "the recording has no scans"
                          : "it has " + std::to_string(index) + "; --scans leaves none"};
}

/// The scans of one laser, or of several.
Result<LaserSet> open_scans(const LocalizeWords& words, ProblemLog& problems) {
  if (words.lasers.are_several()) return open_lasers(words.recording, words.scan, words.lasers, problems);
  auto recording = open_recording(words.recording, words.scan, problems);
  if (!recording) return recording.error();
  return LaserSet{*std::move(recording), {}};
}

/// The pose at the first scan.
Result<Pose2> start_pose(const LocalizeWords& words, const PosesOf& poses, const FirstScan& first) {
  if (auto pose = poses.at(first.index, first.scan.stamp())) return *pose;
  // A reference that begins a moment later than the scans still tells where they begin.
  if (!poses.trajectory.empty() &&
      std::abs(seconds_between(first.scan.stamp(), poses.trajectory.front().stamp)) < 1.0)
    return poses.trajectory.front().pose;
  return Error{words.start_from,
               "there is no pose at the first scan, " + to_string(first.scan.stamp()) + " s",
               "give one by --start x,y,deg"};
}

/// Every scan starts a distance away from its pose, a random way and turned to either side.
StartAt starts_alone(const Alone& alone, PosesOf poses) {
  return [alone, poses = std::move(poses), rng = Rng(1)](std::size_t scan_index,
                                                         Stamp stamp) mutable -> std::optional<Pose2> {
    const double way = rng.uniform(-kPi, kPi);
    const double side = rng.uniform() < 0.5 ? -1.0 : 1.0;
    const auto pose = poses.at(scan_index, stamp);
    if (!pose) return std::nullopt;
    return Pose2{pose->x_m + alone.metres * std::cos(way), pose->y_m + alone.metres * std::sin(way),
                 wrap_angle(pose->theta_rad + side * alone.turn_rad)};
  };
}

/// The start by --start-from.
Result<Done> start_from_poses(const LocalizeWords& words, const LocalizePlan& plan, LocalizeInputs& inputs,
                              ProblemLog& problems) {
  auto poses = poses_of(words.start_from, inputs.recording, words.pose_topic, problems);
  if (!poses) return poses.error();
  const bool is_placed = inputs.recording.laser_place().has_value();  // and told about by itself
  if (!is_placed && poses->tells_laser_apart() && words.base_from_laser.empty() && words.config.empty()) {
    const Pose2& told = *poses->base_from_laser;
    problems.add(
        {words.recording, fmt::format("the log says that the laser sits at {:.3f},{:.3f},{:.1f} on the "
                                      "robot, but --base-from-laser is not given",
                                      told.x_m, told.y_m, degrees(told.theta_rad))});
  }
  const auto start = start_pose(words, *poses, inputs.first);
  if (!start) return start.error();
  inputs.start = StartHere{*start};
  if (plan.alone) inputs.start_at = starts_alone(*plan.alone, *std::move(poses));
  return Done{};
}

}  // namespace

Result<LocalizeInputs> open_inputs(const Console& console, const LocalizeWords& words,
                                   const LocalizePlan& plan, ProblemLog& problems) {
  // 1. The recording, the map, and the first scan.
  auto opened = open_scans(words, problems);
  if (!opened) return opened.error();
  auto [recording, lasers] = *std::move(opened);
  auto map = io::read_map(words.map);
  if (!map) return map.error();
  if (const auto* anywhere = plan.start ? std::get_if<StartAnywhere>(&*plan.start) : nullptr;
      anywhere != nullptr && anywhere->within)
    if (auto on_map = check_on_map(words.start, *anywhere->within, *map); !on_map) return on_map.error();
  auto first = first_scan(recording, plan.scans);
  if (!first) problems.report(console);
  if (!first) return first.error();
  problems.forget();
  problems.listening = false;
  LocalizeInputs inputs{.recording = std::move(recording),
                        .map = std::make_shared<const Map>(*std::move(map)),
                        .lasers = std::move(lasers),
                        .first = *std::move(first),
                        .start = plan.start.value_or(StartAnywhere{}),
                        .start_at = {},
                        .reference = {}};
  // 2. Poses: where it starts, and what it is compared with.
  ProblemLog pose_problems;
  if (words.scan.stamp_is != "first" && inputs.first.scan.sweep_time_s() == 0.0)
    pose_problems.add({words.recording, "its scans tell no time per beam, so --stamp-is " +
                                            words.scan.stamp_is + " changes nothing; --sweep-time tells it"});
  if (!plan.start)
    if (auto started = start_from_poses(words, plan, inputs, pose_problems); !started) {
      pose_problems.report(console);
      return started.error();
    }
  if (!words.reference.empty()) {
    pose_problems.listening = words.reference != words.start_from;  // one file is told about once
    auto poses = poses_of(words.reference, inputs.recording, words.pose_topic, pose_problems);
    if (!poses) return poses.error();
    inputs.reference = *std::move(poses);
  }
  pose_problems.report(console);
  return inputs;
}

}  // namespace beaconless::cli
