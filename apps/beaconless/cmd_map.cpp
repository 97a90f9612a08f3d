// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/grid_io.hpp"
#include "beaconless/map/grid_builder.hpp"

#include "commands.hpp"
#include "laser_set.hpp"
#include "map_features_run.hpp"
#include "map_slam.hpp"
#include "poses_of.hpp"
#include "scan_options.hpp"
#include "words.hpp"

namespace beaconless::cli {
namespace {

struct MapWords {
  std::string recording;
  ScanWords scan;
  std::string poses = "recorded";
  std::string pose_topic;
  std::string base_from_laser;
  LaserWords lasers;
  std::string out;
  GridBuilderConfig builder;
  MapSlamWords slam;
};

/// The scans of one laser, or of several.
Result<LaserSet> open_scans(const MapWords& words, ProblemLog& problems) {
  if (words.lasers.are_several()) return open_lasers(words.recording, words.scan, words.lasers, problems);
  auto recording = open_recording(words.recording, words.scan, problems);
  if (!recording) return recording.error();
  return LaserSet{*std::move(recording), {}};
}

/// Where the laser sits: as told, else as the recording tells it with its poses, else in the base.
Result<Pose2> laser_place(const MapWords& words, const PosesOf& poses) {
  if (!words.base_from_laser.empty()) return pose_from_words("--base-from-laser", words.base_from_laser);
  return poses.base_from_laser.value_or(Pose2{});
}

int build(const Console& console, const MapWords& words) {
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  ProblemLog problems;
  problems.listening = false;
  const auto opened = open_scans(words, problems);
  if (!opened) return console.fail(opened.error());
  const auto& [recording, lasers] = *opened;
  ProblemLog pose_problems;
  const auto poses = poses_of(words.poses, recording, words.pose_topic, pose_problems);
  pose_problems.report(console);
  if (!poses) return console.fail(poses.error());
  const auto place = laser_place(words, *poses);
  if (!place) return console.fail(place.error(), exit_usage);
  const LocalizerConfig places{.base_from_laser = *place, .lasers = lasers};
  const io::ScanSelection taken = lasers.empty() ? *scans : io::ScanSelection{};
  auto builder = GridBuilder::make(words.builder);
  if (!builder) return console.fail(builder.error(), exit_usage);

  problems.listening = true;
  std::size_t scan_index = 0;
  std::size_t used = 0;
  std::size_t without_pose = 0;
  Progress progress(console, "scan", 0);
  for (const Event& event : recording) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    const std::size_t index = scan_index++;
    progress.step();
    const auto map_from_base = taken.wants(index) ? poses->at(index, scan->stamp()) : std::nullopt;
    if (map_from_base) {
      if (auto added =
              builder.value().add(*scan, *map_from_base * base_from_laser_of(places, scan->frame_id()));
          !added)
        return console.fail(
            {fmt::format("{}: scan {}", words.recording, index), added.error().what, added.error().remedy});
      ++used;
    } else if (taken.wants(index)) {
      ++without_pose;
    }
    if (taken.done_after(index)) break;
  }
  problems.report(console);
  if (without_pose > 0)
    console.warn(fmt::format("{} scans have no pose at their stamp and were left out", without_pose));
  if (used == 0)
    return console.fail({words.recording, "no scan had a pose", "check --poses, --scans and the stamps"});
  const OccupancyGrid grid = builder->grid();
  if (auto written = io::write_grid(words.out, grid); !written) return console.fail(written.error());
  console.say(fmt::format("{}: {} x {} cells of {} m from {} scans", words.out, grid.width_cells,
                          grid.height_cells, grid.resolution_m, used));
  console.result({{"out", words.out},
                  {"width_cells", grid.width_cells},
                  {"height_cells", grid.height_cells},
                  {"resolution_m", grid.resolution_m},
                  {"scans", used},
                  {"without_pose", without_pose}});
  return exit_good;
}

/// The options that both ways share, and whether those of one were given to the other.
int build_by_slam(const Console& console, const CLI::App& command, const MapWords& words) {
  for (const char* option : {"--poses", "--pose-topic"})
    if (command.count(option) > 0)
      return console.fail({option, "SLAM finds the poses itself", "leave it out, or leave out --slam"},
                          exit_usage);
  if (words.lasers.are_several())
    return console.fail({"--topic", "--slam takes the scans of one laser", "name one --topic"}, exit_usage);
  MapSlamWords slam = words.slam;
  slam.recording = words.recording;
  slam.scan = words.scan;
  slam.base_from_laser = words.base_from_laser;
  slam.out = words.out;
  if (command.count("--resolution") > 0) slam.resolution_m = words.builder.resolution_m;
  if (command.count("--p-occupied") > 0) slam.p_occupied = words.builder.p_occupied;
  if (command.count("--p-free") > 0) slam.p_free = words.builder.p_free;
  return map_by_slam(console, slam);
}

int build_either_way(const Console& console, const CLI::App& command, const MapWords& words) {
  if (!words.slam.method.empty()) return build_by_slam(console, command, words);
  for (const char* option : {"--out-poses", "--plot", "--start", "--config", "--set"})
    if (command.count(option) > 0)
      return console.fail({option, "it goes with --slam only", "add --slam hector, or leave it out"},
                          exit_usage);
  return build(console, words);
}

}  // namespace

void add_map(CLI::App& app, Console& console, int& exit_code) {
  auto* map = app.add_subcommand("map", "Make maps, and look at them");
  map->require_subcommand(1);
  add_map_features(*map, console, exit_code);
  auto* command =
      map->add_subcommand("build", "An occupancy grid from a recording, with known poses or without");
  auto words = std::make_shared<MapWords>();
  command->add_option("recording", words->recording, "The recording")->required();
  command->add_option("--out", words->out, "The map's YAML; the picture is written beside it")->required();
  command
      ->add_option("--slam", words->slam.method,
                   "Without any poses: find them on the way, by this method (hector)")
      ->check(CLI::IsMember({"hector"}));
  command->add_option("--out-poses", words->slam.out_poses, "The poses found by --slam, a TUM file");
  command->add_option("--plot", words->slam.plot, "The map with the path found by --slam, as SVG");
  command->add_option("--start", words->slam.start,
                      "Where --slam begins in the map, x,y,deg (default 0,0,0)");
  command->add_option("--config", words->slam.config, "Parameters of --slam from a YAML file");
  command->add_option("--set", words->slam.set, "One parameter of --slam, name=value; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--poses", words->poses, "Poses of the base: a TUM file, or 'recorded'")
      ->capture_default_str();
  command->add_option("--pose-topic", words->pose_topic,
                      "Which poses 'recorded' means, where there are several");
  command
      ->add_option("--base-from-laser", words->lasers.places,
                   "The laser on the robot, x,y,deg (default: as the recording tells); of several one each")
      ->allow_extra_args(false);
  command->add_option("--resolution", words->builder.resolution_m, "Side of a cell [m]")
      ->capture_default_str();
  command->add_option("--p-occupied", words->builder.p_occupied, "Probability of a cell where a beam ends")
      ->capture_default_str();
  command
      ->add_option("--p-free", words->builder.p_free,
                   "Probability of a cell that a beam crosses (with --slam 0.4)")
      ->capture_default_str();
  command
      ->add_option("--topic", words->lasers.topics,
                   "Which scans: a topic of a bag, a keyword of a log; of several lasers one topic each")
      ->allow_extra_args(false);
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  add_scan_time_options(*command, words->scan);
  add_scan_range_options(*command, words->scan);
  command->footer(
      "Examples: beaconless map build drive.log --poses recorded --resolution 0.05 --out hall.yaml\n"
      "          beaconless map build drive.log --slam hector --out hall.yaml --out-poses drive.tum");
  command->callback([&console, &exit_code, words, command] {
    words->lasers.settle_one(words->scan.topic, words->base_from_laser);
    exit_code = build_either_way(console, *command, *words);
  });
}

}  // namespace beaconless::cli
