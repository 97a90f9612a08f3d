// SPDX-License-Identifier: Apache-2.0
#include "localize_run.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/core/rng.hpp"
#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/yaml_tree.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "poses_of.hpp"
#include "replay.hpp"
#include "run_files.hpp"

namespace beaconless::cli {
namespace {

/// A file that holds no parameters at all is wrong data; a wrong parameter in it is a wrong word of the call.
Result<Done> check_config_file(const std::string& path) {
  if (path.empty()) return Done{};
  const auto yaml = io::read_yaml(path);
  if (!yaml) return yaml.error();
  if (yaml->kind == io::YamlNode::Kind::map || yaml->kind == io::YamlNode::Kind::null) return Done{};
  return Error{io::where_in(path, *yaml), "holds " + yaml->described(),
               "a config is lines of `parameter: value`"};
}

/// The options that stand for parameters, as those.
std::vector<std::string> shorthands(const LocalizeWords& words) {
  std::vector<std::string> set;
  if (!words.line_fit.empty())
    set.push_back("features.corners.lines.fit.method=" +
                  std::string(words.line_fit == "lsf" ? "regression" : words.line_fit));
  if (!words.loss.empty())
    for (const char* name : {"icp.loss", "feature_icp.loss"}) set.push_back(name + ("=" + words.loss));
  if (words.sigma_m > 0.0)
    for (const char* name :
         {"walls.sigma_m", "icp.sigma_m", "hector.sigma_m", "features.corners.lines.sigma_m",
          "features.falko.sigma_m", "features.rdp.segmentation.sigma_m"})
      set.push_back(fmt::format("{}={}", name, words.sigma_m));
  return set;
}

/// Refuses options that the method would not hear of.
Result<Done> check_effect(const LocalizeWords& words, const std::string& method) {
  const bool is_icp = method.starts_with("icp-");
  const bool is_of_corners = method.starts_with("icp-corners");
  const bool is_of_whole_scans = method == "walls" || method.ends_with("-full");
  const auto refused = [&](const char* option, const char* for_whom) {
    return Error{option, "it changes nothing about " + method,
                 std::string("leave it out; it is for ") + for_whom};
  };
  if (!words.line_fit.empty() && !is_of_corners)
    return refused("--line-fit", "icp-corners and icp-corners-ft");
  if (!words.loss.empty() && !is_icp) return refused("--loss", "the methods that begin with icp");
  if (!words.preset.empty() && is_of_whole_scans) return refused("--preset", "methods of features");
  return Done{};
}

/// The run's configuration: defaults, then the file, then the options, then each --set.
Result<LocalizerConfig> config_of(const LocalizeWords& words) {
  LocalizerConfig config;
  const auto fields = fields_of(config);
  if (!words.config.empty())
    if (auto read = io::read_config(words.config, fields); !read) return read.error();
  if (!words.method.empty()) config.method = words.method;
  if (auto heard = check_effect(words, config.method); !heard) return heard.error();
  if (!words.preset.empty()) {
    const auto preset = detectors_preset(words.preset);
    if (!preset) return preset.error();
    config.features.detectors = *preset;
  }
  if (auto set = set_parameters(fields, shorthands(words)); !set) return set.error();
  if (!words.base_from_laser.empty()) {
    const auto pose = pose_from_words("--base-from-laser", words.base_from_laser);
    if (!pose) return pose.error();
    config.base_from_laser = *pose;
  }
  if (auto set = set_parameters(fields, words.set); !set) return set.error();
  return config;
}

struct FirstScan {
  std::size_t index = 0;
  Scan scan;
};

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

/// Where the robot starts, by the words of the call.
Result<Pose2> start_pose(const LocalizeWords& words, const io::Recording& recording, const FirstScan& first,
                         ProblemLog& problems) {
  if (!words.start.empty()) return pose_from_words("--start", words.start);
  const auto poses = poses_of(words.start_from, recording, words.pose_topic, problems);
  if (!poses) return poses.error();
  if (poses->tells_laser_apart() && words.base_from_laser.empty() && words.config.empty()) {
    const Pose2& told = *poses->base_from_laser;
    problems.add(
        {words.recording, fmt::format("the log says that the laser sits at {:.3f},{:.3f},{:.1f} on the "
                                      "robot, but --base-from-laser is not given",
                                      told.x_m, told.y_m, degrees(told.theta_rad))});
  }
  if (auto pose = poses->at(first.index, first.scan.stamp())) return *pose;
  // A reference that begins a moment later than the scans still tells where they begin.
  if (!poses->trajectory.empty() &&
      std::abs(seconds_between(first.scan.stamp(), poses->trajectory.front().stamp)) < 1.0)
    return poses->trajectory.front().pose;
  return Error{words.start_from,
               "there is no pose at the first scan, " + to_string(first.scan.stamp()) + " s",
               "give one by --start x,y,deg"};
}

/// The reference at every scan: its own where its line tells one, because stamps of logs may repeat.
Trajectory reference_of(const Replay& replay, const PosesOf& poses) {
  if (poses.by_scan.empty()) return poses.trajectory;
  Trajectory reference;
  for (std::size_t i = 0; i < replay.estimates.size(); ++i)
    if (const auto pose = poses.at(replay.scan_indices[i], replay.estimates[i].stamp))
      reference.add(replay.estimates[i].stamp, *pose);
  return reference;
}

/// What `--alone` says: how far from its reference each scan starts, a random way and turned to either side.
Result<StartAt> starts_alone(const LocalizeWords& words, const PosesOf& poses) {
  const auto parts = split_words(words.alone, ", ");
  const auto metres = parts.size() == 2 ? parse_double(parts[0]) : std::nullopt;
  const auto turn_deg = parts.size() == 2 ? parse_double(parts[1]) : std::nullopt;
  if (!metres || !turn_deg || !(std::abs(*metres) < 100.0) || !(std::abs(*turn_deg) <= 180.0))
    return Error{"--alone", "\"" + words.alone + "\" is no distance and turn",
                 "write METRES,DEGREES, for example 0.3,10"};
  return StartAt([&poses, metres = *metres, turn_rad = radians(*turn_deg), rng = Rng(1)](
                     std::size_t scan_index, Stamp stamp) mutable -> std::optional<Pose2> {
    const double way = rng.uniform(-kPi, kPi);
    const double side = rng.uniform() < 0.5 ? -1.0 : 1.0;
    const auto pose = poses.at(scan_index, stamp);
    if (!pose) return std::nullopt;
    return Pose2{pose->x_m + metres * std::cos(way), pose->y_m + metres * std::sin(way),
                 wrap_angle(pose->theta_rad + side * turn_rad)};
  });
}

}  // namespace

int localize_run(const Console& console, const LocalizeWords& words) {
  // 1. What was asked for.
  if (auto config_file = check_config_file(words.config); !config_file)
    return console.fail(config_file.error());
  const auto config = config_of(words);
  if (!config) return console.fail(config.error(), exit_usage);
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  if (words.start.empty() == words.start_from.empty())
    return console.fail({"start", "the start pose is not given, or given twice",
                         "give --start x,y,deg or --start-from REF.tum|recorded"},
                        exit_usage);
  // 2. Open what is to be read.
  if (!words.out.empty())
    if (auto made = make_folder(words.out); !made) return console.fail(made.error());
  ProblemLog problems;
  const auto recording = open_recording(words.recording, words.scan, problems);
  if (!recording) return console.fail(recording.error());
  auto map = io::read_map(words.map);
  if (!map) return console.fail(map.error());
  const auto shared_map = std::make_shared<const Map>(*std::move(map));
  const auto first = first_scan(*recording, *scans);
  if (!first) problems.report(console);
  if (!first) return console.fail(first.error());
  problems.forget();
  problems.listening = false;
  ProblemLog pose_problems;
  StartAt start_at;
  PosesOf starts;
  if (!words.alone.empty()) {
    if (words.start_from.empty())
      return console.fail({"--alone", "it needs a pose of every scan", "give --start-from REF.tum|recorded"},
                          exit_usage);
    auto poses = poses_of(words.start_from, *recording, words.pose_topic, pose_problems);
    if (!poses) return console.fail(poses.error());
    starts = *std::move(poses);
    auto alone = starts_alone(words, starts);
    if (!alone) return console.fail(alone.error(), exit_usage);
    start_at = *std::move(alone);
    pose_problems.forget();
  }
  if (words.scan.stamp_is != "first" && first->scan.sweep_time_s() == 0.0)
    pose_problems.add({words.recording, "its scans tell no time per beam, so --stamp-is " +
                                            words.scan.stamp_is + " changes nothing; --sweep-time tells it"});
  const auto start = start_pose(words, *recording, *first, pose_problems);
  if (!start) pose_problems.report(console);
  if (!start) return console.fail(start.error(), words.start.empty() ? exit_data : exit_usage);
  std::optional<PosesOf> reference;
  if (!words.reference.empty()) {
    if (words.reference == words.start_from) pose_problems.forget();
    auto poses = poses_of(words.reference, *recording, words.pose_topic, pose_problems);
    if (!poses) return console.fail(poses.error());
    reference = *std::move(poses);
  }
  pose_problems.report(console);
  // 3. Localize.
  auto localizer = make_localizer(*config, *shared_map);
  if (!localizer && localizer.error().where == "map")
    return console.fail({words.map, localizer.error().what, localizer.error().remedy});
  if (!localizer) return console.fail(localizer.error(), exit_usage);
  (*localizer)->start_at(*start);
  Run run{.config = *config, .map = shared_map, .reference = {}, .first_scan = first->scan};
  problems.listening = true;
  run.replay = replay(*recording, *scans, **localizer, config->base_from_laser, console, start_at);
  if (run.replay.estimates.empty())
    return console.fail({words.recording, "its scans are gone", "did it change while it was read?"});
  if (reference) run.reference = reference_of(run.replay, *reference);
  run.problems = problems.lines();
  problems.report(console);
  // 4. Write and tell what came of it.
  return finish_run(console, words, run);
}

}  // namespace beaconless::cli
