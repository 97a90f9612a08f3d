// SPDX-License-Identifier: Apache-2.0
#include "run_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/report/run_report.hpp"

#include "run_summary.hpp"
#include "start_words.hpp"
#include "tables.hpp"

namespace beaconless::cli {
namespace {

namespace fs = std::filesystem;

/// The poses that are given for one: a robot that is being found has none yet, and a window only a good one.
Trajectory told_poses(const Run& run) {
  std::vector<StampedPose> poses;
  for (const PoseEstimate& estimate : run.replay.estimates) {
    const bool is_told = estimate.status != Status::relocalizing && estimate.status != Status::not_started;
    if (is_told && (!run.windows || estimate.ok())) poses.push_back({estimate.stamp, estimate.map_from_base});
  }
  return Trajectory(std::move(poses));
}

std::string config_text(const Run& run) {
  LocalizerConfig config = run.config;
  LocalizerConfig defaults;
  std::string lasers;
  for (const LaserOnRobot& laser : config.lasers) {
    const Pose2& at = laser.base_from_laser;
    lasers +=
        fmt::format("#   {}: {},{},{}\n", json_text(laser.frame_id), at.x_m, at.y_m, degrees(at.theta_rad));
  }
  if (!lasers.empty())
    lasers =
        "# The lasers by the frames of their scans, as --base-from-laser and --topic told them (not part of\n"
        "# this file: they are given again; base_from_laser below is that of none):\n" +
        lasers;
  return lasers + io::config_yaml(fields_of(config), fields_of(defaults));
}

report::RunReport report_of(const LocalizeWords& words, const Run& run,
                            const std::optional<Judgement>& judgement) {
  report::RunReport page;
  page.title = words.title.empty() ? fs::path(words.recording).filename().string() : words.title;
  page.method = run.config.method;
  page.map_name = fs::path(words.map).filename().string();
  page.recording_name = fs::path(words.recording).filename().string();
  page.command_line = words.command_line;
  page.map = run.map;
  page.estimates = run.replay.estimates;
  page.reference = run.reference;
  page.scans = run.replay.overlay;
  page.good_scans = run.replay.good_scans;
  page.places = run.replay.places;
  if (run.reference) page.judged = eval::judge_estimates(run.replay.estimates, *run.reference);
  page.update_times_us = run.replay.update_us;
  page.config_text = config_text(run);
  page.problems = run.problems;
  if (run.replay.skipped_records > 0)
    page.problems.push_back(
        fmt::format("{} records of the recording were passed over", run.replay.skipped_records));
  for (const auto& [reason, count] : reason_counts(run))
    page.problems.push_back(fmt::format("{} of {} scans {}", count, run.replay.estimates.size(), reason));
  for (const std::string& jump : jumps_of(run)) page.problems.push_back(jump);
  if (!judgement) return page;
  page.errors = judgement->evaluation.errors;
  page.bounds = judgement->bounds;
  page.error = judgement->evaluation.raw;
  page.error_aligned = judgement->evaluation.aligned;
  page.bound_ratio = judgement->crb_ratio;
  return page;
}

/// Writes the files of a run into a folder that is there; gives their paths.
Result<std::vector<std::string>> write_files(const fs::path& folder, const Run& run,
                                             const nlohmann::json& summary, const report::RunReport& page) {
  std::vector<std::string> paths;
  const auto path_of = [&](const char* name) { return paths.emplace_back((folder / name).string()); };

  io::TumWriter trajectory(path_of("trajectory.tum"));
  for (const PoseEstimate& estimate : run.replay.estimates) trajectory.write(estimate);
  if (auto written = trajectory.finish(); !written) return written.error();
  io::EstimatesCsvWriter csv(path_of("estimates.csv"));
  for (const PoseEstimate& estimate : run.replay.estimates) csv.write(estimate);
  if (auto written = csv.finish(); !written) return written.error();
  const std::string windows = run.windows ? run.windows->csv : "";
  for (const auto& [name, text] : {std::pair{"config.yaml", config_text(run)},
                                   {"summary.json", json_text(summary) + "\n"},
                                   {"map.svg", report::draw_run_svg(page)},
                                   {"report.html", report::html(page)},
                                   {"windows.csv", windows}}) {
    if (text.empty()) continue;
    const std::string path = path_of(name);
    std::ofstream out(path, std::ios::binary);
    out << text;
    if (!out.flush()) return Error{path, "cannot be written", "is there space, and may you write there?"};
  }
  return paths;
}

void tell(const Console& console, const Run& run, const nlohmann::json& summary,
          const std::optional<Judgement>& judgement) {
  std::string counts;
  for (const auto& [status, count] : status_counts(run))
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, status);
  const auto& times = summary["update_us"];
  console.say(fmt::format("{} {} by {}: {}", run.replay.estimates.size(), run.windows ? "windows" : "scans",
                          run.config.method, counts));
  for (const auto& [reason, count] : reason_counts(run)) console.say(fmt::format("  {} {}", count, reason));
  for (const std::string& line : ambiguous_lines(run)) console.say(line);
  if (const std::size_t jumps = jumps_of(run).size(); jumps > 0)
    console.say(fmt::format("the pose jumped {} time{}", jumps, jumps == 1 ? "" : "s"));
  console.say(fmt::format("update: median {:.0f} µs, p99 {:.0f} µs, max {:.0f} µs",
                          times["median"].get<double>(), times["p99"].get<double>(),
                          times["max"].get<double>()));
  if (run.windows)
    for (const std::string& line : run.windows->lines) console.say(line);
  if (!judgement) return;
  console.say("\nerror against the reference, as it is\n" + table_text(judgement->evaluation.raw));
  console.say("after rigid alignment\n" + table_text(judgement->evaluation.aligned));
  if (judgement->crb_ratio)
    console.say(fmt::format("{:.2f} (position) and {:.2f} (heading) times the Cramér–Rao bound\n",
                            judgement->crb_ratio->position, judgement->crb_ratio->heading));
}

/// Of a robot that was never found: what may be wrong, by what was said of where it is.
std::string never_found(const LocalizeWords& words) {
  const std::string check = "the robot is lost, it was never found: check ";
  const auto start = start_from_words(words.start);
  if (!start || std::holds_alternative<StartHere>(*start))
    return check + "the start pose, the map and --base-from-laser";
  const auto* anywhere = std::get_if<StartAnywhere>(&*start);
  if (anywhere != nullptr && anywhere->within)
    return check + "the region, the map and --base-from-laser, or search everywhere by --start auto";
  return check + "the map and --base-from-laser, drive on until more walls are in view, or give a start pose";
}

/// How it ended: the exit code, and a word about it where it is not good.
int tell_end(const Console& console, const LocalizeWords& words, const Run& run) {
  const auto& estimates = run.replay.estimates;
  const auto is_any = [&](Status status) {
    return std::any_of(estimates.begin(), estimates.end(), [&](const auto& e) { return e.status == status; });
  };
  const bool ever_found = is_any(Status::ok);
  const Status end = estimates.back().status;
  if (ever_found && (run.windows || (end != Status::lost && end != Status::relocalizing))) return exit_good;
  console.warn(run.windows ? "no window was found"
               : end == Status::relocalizing
                   ? "at the end of the recording several places fit: drive on, or say "
                     "where by --start near:x,y,radius"
               : ever_found ? "the robot is lost at the end of the recording"
               : is_any(Status::lost)
                   ? never_found(words)
                   : run.config.method + " found no pose itself: try another method, or other parameters");
  return exit_lost;
}

}  // namespace

Result<RunFolder> RunFolder::make(const std::string& path) {
  std::error_code failed;
  if (path.empty() || fs::is_directory(path, failed)) return RunFolder({});
  fs::create_directories(path, failed);
  if (failed) return Error{path, failed.message(), "choose another --out"};
  return RunFolder(path);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);  // which spares one that holds anything
}

int finish_run(const Console& console, const LocalizeWords& words, const Run& run) {
  std::optional<Judgement> judgement;
  if (const Trajectory told = told_poses(run); run.reference && !told.empty()) {
    const bool is_of_one = run.config.lasers.empty();  // the bound of several lasers is another
    judgement = judge(told, *run.reference, is_of_one ? run.map.get() : nullptr,
                      eval::sensor_of(run.first_scan, run.config.icp.sigma_m), run.config.base_from_laser);
    if (judgement->evaluation.errors.empty()) {
      console.warn("no estimate has a reference at its stamp; do both use the same clock?");
      judgement.reset();
    }
  }
  const nlohmann::json summary = summary_of(words, run, judgement);
  tell(console, run, summary, judgement);
  if (!words.out.empty()) {
    const auto paths = write_files(words.out, run, summary, report_of(words, run, judgement));
    if (!paths) return console.fail(paths.error());
    console.say("written:");
    for (const std::string& path : *paths) console.say("  " + path);
  }
  console.result(summary);
  return tell_end(console, words, run);
}

}  // namespace beaconless::cli
