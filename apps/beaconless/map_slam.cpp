// SPDX-License-Identifier: Apache-2.0
#include "map_slam.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "beaconless/eval/errors.hpp"
#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/grid_io.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/io/whole_file.hpp"
#include "beaconless/report/map_view.hpp"
#include "beaconless/slam/hector_slam.hpp"

#include "laser_words.hpp"
#include "poses_of.hpp"
#include "slam_parameters.hpp"

namespace beaconless::cli {
namespace {

/// Defaults, then the file, then the options, then each --set.
Result<HectorSlamConfig> config_of(const MapSlamWords& words) {
  SlamParameters parameters;
  HectorSlamConfig& config = parameters.hector_slam;
  const auto fields = fields_of(parameters);
  if (!words.config.empty())
    if (auto read = io::read_config(words.config, fields); !read) return read.error();
  config.map.resolution_m = words.resolution_m.value_or(config.map.resolution_m);
  config.map.p_occupied = words.p_occupied.value_or(config.map.p_occupied);
  config.map.p_free = words.p_free.value_or(config.map.p_free);
  if (!words.base_from_laser.empty()) {
    const auto pose = pose_from_words("--base-from-laser", words.base_from_laser);
    if (!pose) return pose.error();
    config.base_from_laser = *pose;
  }
  if (auto set = set_parameters(fields, words.set); !set) return set.error();
  return config;
}

/// Refuses to write over what is read, or two things into one file.
Result<Done> check_paths(const MapSlamWords& words) {
  const auto is_same = [](const std::string& a, const std::string& b) {
    std::error_code none;
    return !a.empty() && !b.empty() && (a == b || std::filesystem::equivalent(a, b, none));
  };
  for (const std::string& out : {words.out, words.out_poses, words.plot})
    for (const std::string& in : {words.recording, words.config})
      if (is_same(out, in))
        return Error{out, "this file is read, and would be written over", "give another name"};
  if (is_same(words.out, words.out_poses) || is_same(words.out, words.plot) ||
      is_same(words.out_poses, words.plot))
    return Error{words.out, "two results would go into the same file", "give each a name of its own"};
  return Done{};
}

/// Finds out before a long run whether its files will have a folder.
Result<Done> check_folders(const MapSlamWords& words) {
  for (const std::string& out : {words.out, words.out_poses, words.plot}) {
    const auto folder = std::filesystem::path(out).parent_path();
    std::error_code none;
    if (!folder.empty() && !std::filesystem::is_directory(folder, none))
      return Error{out, "there is no such folder", "make it first, or choose another name"};
  }
  return Done{};
}

/// What a drive through a recording gave.
struct SlamRun {
  std::vector<PoseEstimate> estimates;  ///< one a scan that was taken
  std::vector<double> update_us;

  std::map<std::string_view, int> status_counts() const {
    std::map<std::string_view, int> counts;
    for (const PoseEstimate& estimate : estimates) ++counts[to_string(estimate.status)];
    return counts;
  }
  double length_m() const {
    double length = 0.0;
    for (std::size_t i = 1; i < estimates.size(); ++i)
      length += distance_m(estimates[i - 1].map_from_base, estimates[i].map_from_base);
    return length;
  }
};

std::uint64_t scans_of(const io::Recording& recording) {
  for (const io::Topic& topic : recording.topics())
    if (topic.name == recording.scan_topic()) return topic.count;
  return 0;
}

SlamRun drive(const Console& console, const io::Recording& recording, const io::ScanSelection& scans,
              HectorSlam& slam) {
  using Clock = std::chrono::steady_clock;
  SlamRun run;
  Progress progress(console, "scan", scans_of(recording));
  std::size_t scan_index = 0;
  for (const Event& event : recording) {
    const bool is_scan = std::holds_alternative<Scan>(event);
    const std::size_t index = scan_index;
    if (is_scan) {
      ++scan_index;
      progress.step();
    }
    if (is_scan && !scans.wants(index)) continue;
    const auto begin = Clock::now();
    const PoseEstimate estimate = slam.update(event);
    if (!is_scan) continue;
    run.update_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    run.estimates.push_back(estimate);
    if (scans.done_after(index)) break;
  }
  return run;
}

Result<Done> write_poses(const std::string& path, const SlamRun& run) {
  if (path.empty()) return Done{};
  io::TumWriter poses(path);
  for (const PoseEstimate& estimate : run.estimates) poses.write(estimate);
  return poses.finish();
}

Result<Done> write_plot(const std::string& path, const OccupancyGrid& grid, const SlamRun& run) {
  if (path.empty()) return Done{};
  return io::write_whole_file(path, report::svg_file(report::draw_map(Map(grid), run.estimates)));
}

void tell(const Console& console, const MapSlamWords& words, const OccupancyGrid& grid,
          const HectorSlam& slam, SlamRun& run) {
  std::string counts;
  for (const auto& [status, count] : run.status_counts())
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, status);
  const eval::Statistics times = eval::statistics_of(std::move(run.update_us));
  console.say(fmt::format("{}: {} x {} cells of {} m", words.out, grid.width_cells, grid.height_cells,
                          grid.resolution_m));
  console.say(fmt::format("{} scans, {:.1f} m, {} of them drawn: {}", run.estimates.size(), run.length_m(),
                          slam.map().scan_count(), counts));
  console.say(fmt::format("update: median {:.0f} µs, p95 {:.0f} µs, max {:.0f} µs", times.median, times.p95,
                          times.max));
  if (!words.out_poses.empty()) console.say(words.out_poses + ": the poses");
  if (!words.plot.empty()) console.say(words.plot + ": the map with the path");
  console.result({{"out", words.out},
                  {"width_cells", grid.width_cells},
                  {"height_cells", grid.height_cells},
                  {"resolution_m", grid.resolution_m},
                  {"scans", run.estimates.size()},
                  {"drawn", slam.map().scan_count()},
                  {"length_m", run.length_m()},
                  {"status_counts", run.status_counts()},
                  {"update_us", {{"median", times.median}, {"p95", times.p95}, {"max", times.max}}}});
}

/// Where the recording says that the laser sits: its fixed frames, or a log that tells laser and robot apart.
std::optional<Pose2> told_place(const Console& console, const io::Recording& recording) {
  if (const auto& told = recording.laser_place()) {
    console.note(laser_words(*told));
    return told->base_from_laser;
  }
  ProblemLog unheard;
  const auto poses = poses_of("recorded", recording, "", unheard);
  if (!poses || !poses->tells_laser_apart()) return std::nullopt;
  const Pose2 told = *poses->base_from_laser;
  console.note(fmt::format("the log says that the laser sits at {:.3f},{:.3f},{:.1f} on the robot", told.x_m,
                           told.y_m, degrees(told.theta_rad)));
  return told;
}

}  // namespace

int map_by_slam(const Console& console, const MapSlamWords& words) {
  // 1. What was asked for.
  auto config = config_of(words);
  if (!config) return console.fail(config.error(), exit_usage);
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  const auto start = pose_from_words("--start", words.start.empty() ? "0,0,0" : words.start);
  if (!start) return console.fail(start.error(), exit_usage);
  if (auto paths = check_paths(words); !paths) return console.fail(paths.error(), exit_usage);
  if (auto folders = check_folders(words); !folders) return console.fail(folders.error());
  // 2. Drive.
  ProblemLog problems;
  const auto recording = open_recording(words.recording, words.scan, problems);
  if (!recording) return console.fail(recording.error());
  if (const auto told = told_place(console, *recording); told && config->base_from_laser == Pose2{})
    config.value().base_from_laser = *told;
  auto slam = HectorSlam::make(*config, *start);
  if (!slam) return console.fail(slam.error(), exit_usage);
  SlamRun run = drive(console, *recording, *scans, slam.value());
  problems.report(console);
  // 3. Write.
  const OccupancyGrid grid = slam->grid();
  if (grid.occupancy_percent.empty())
    return console.fail(
        {words.recording, "no scan began a map",
         run.estimates.empty() ? "check --topic and --scans" : std::string(run.estimates.back().reason)});
  if (auto written = io::write_grid(words.out, grid); !written) return console.fail(written.error());
  if (auto written = write_poses(words.out_poses, run); !written) return console.fail(written.error());
  if (auto written = write_plot(words.plot, grid, run); !written) return console.fail(written.error());
  // 4. Tell.
  const bool is_lost = run.estimates.back().status == Status::lost;
  const std::string_view reason = run.estimates.back().reason;
  tell(console, words, grid, slam.value(), run);
  if (!is_lost) return exit_good;
  console.warn(fmt::format("the robot is lost at the end of the recording: {}", reason));
  return exit_lost;
}

}  // namespace beaconless::cli
