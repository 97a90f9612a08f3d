// SPDX-License-Identifier: Apache-2.0
#include "features_run.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "beaconless/eval/repeatability.hpp"
#include "beaconless/io/whole_file.hpp"

#include "features_pictures.hpp"
#include "poses_of.hpp"

namespace beaconless::cli {
namespace {

/// What one detector found, scan by scan.
struct Found {
  Detector detector;
  std::vector<std::vector<Eigen::Vector2d>> points;  ///< a scan that was taken, sensor frame
  std::size_t count = 0;
};

/// All that is kept of the recording.
struct Harvest {
  std::vector<Found> found;
  std::vector<Scan> scans;                ///< only where they are asked for again
  std::vector<std::size_t> scan_indices;  ///< of those taken, in the recording
  std::optional<Scan> plotted;
  std::size_t plotted_index = 0;
  std::string csv = "scan,detector,beam,x_m,y_m,orientation_rad,scale_m,score\n";
};

Result<std::vector<Detector>> detectors_of(const FeaturesWords& words) {
  std::vector<Detector> wanted;
  for (const std::string& name : words.detectors) {
    const auto detector = detector_named(name);
    if (!detector)
      return Error{"--detector", detector.error().where + ": " + detector.error().what,
                   detector.error().remedy};
    if (std::ranges::find(wanted, *detector) == wanted.end()) wanted.push_back(*detector);
  }
  return wanted;
}

Result<DetectorsConfig> config_of(const FeaturesWords& words) {
  const auto preset = detectors_preset(words.preset);
  if (!preset) return preset.error();
  DetectorsConfig config = *preset;
  if (auto set = set_parameters(fields_of(config), words.set); !set) return set.error();
  if (auto checked = check_config(config); !checked) return checked.error();
  return config;
}

void add_rows(std::string& csv, std::size_t scan, Detector detector, const std::vector<Keypoint>& keypoints) {
  for (const Keypoint& k : keypoints)
    fmt::format_to(std::back_inserter(csv), "{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.9g}\n", scan,
                   to_string(detector), k.beam, k.point.x(), k.point.y(), k.orientation_rad, k.scale_m,
                   k.score);
}

/// Runs the detectors over the scans that are wanted.
Harvest harvest_of(const Console& console, const io::Recording& recording, const io::ScanSelection& scans,
                   const FeaturesWords& words, std::span<const Detector> wanted,
                   const DetectorsConfig& config) {
  Harvest harvest;
  for (const Detector detector : wanted) harvest.found.push_back({.detector = detector});
  DetectorScratch scratch;
  std::vector<Keypoint> keypoints;
  Progress progress(console, "scans", 0);
  std::size_t index = 0;
  for (const Event& event : recording) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    const std::size_t at = index++;
    if (scans.wants(at)) {
      progress.step();
      harvest.scan_indices.push_back(at);
      for (Found& found : harvest.found) {
        detect(*scan, found.detector, config, scratch, keypoints);
        found.count += keypoints.size();
        if (!words.csv.empty()) add_rows(harvest.csv, at, found.detector, keypoints);
        if (words.reference.empty()) continue;
        found.points.emplace_back();
        for (const Keypoint& keypoint : keypoints) found.points.back().push_back(keypoint.point);
      }
      if (!words.reference.empty()) harvest.scans.push_back(*scan);
      const bool shown =
          words.plotted_scan < 0 ? !harvest.plotted : at == static_cast<std::size_t>(words.plotted_scan);
      if (shown) harvest.plotted = *scan;
      if (shown) harvest.plotted_index = at;
    }
    if (scans.done_after(at)) break;
  }
  return harvest;
}

/// How well each detector's keypoints are found again; one a detector.
Result<std::vector<eval::Repeatability>> repeatabilities(const FeaturesWords& words,
                                                         const io::Recording& recording,
                                                         const Harvest& harvest, ProblemLog& problems) {
  const auto poses = poses_of(words.reference, recording, words.pose_topic, problems);
  if (!poses) return poses.error();
  Pose2 base_from_laser;
  if (!words.base_from_laser.empty()) {
    const auto pose = pose_from_words("--base-from-laser", words.base_from_laser);
    if (!pose) return pose.error();
    base_from_laser = *pose;
  }
  std::vector<Pose2> map_from_laser;
  for (std::size_t k = 0; k < harvest.scans.size(); ++k) {
    const auto pose = poses->at(harvest.scan_indices[k], harvest.scans[k].stamp());
    if (!pose)
      return Error{words.reference, fmt::format("there is no pose at scan {}", harvest.scan_indices[k]),
                   "take scans that it covers, by --scans"};
    map_from_laser.push_back(*pose * base_from_laser);
  }
  std::vector<eval::Repeatability> all;
  for (const Found& found : harvest.found) {
    std::vector<eval::View> views;
    for (std::size_t k = 0; k < harvest.scans.size(); ++k)
      views.push_back({&harvest.scans[k], map_from_laser[k], found.points[k]});
    all.push_back(
        eval::repeatability(views, static_cast<std::size_t>(words.gap), {.within_m = words.within_m}));
  }
  return all;
}

void say(const Console& console, const FeaturesWords& words, const Harvest& harvest,
         const std::vector<eval::Repeatability>& again) {
  const auto scans = static_cast<double>(harvest.scan_indices.size());
  console.say(fmt::format("{} scans", harvest.scan_indices.size()));
  if (again.empty())
    console.say(fmt::format("{:<16} {:>10}", "detector", "per scan"));
  else
    console.say(fmt::format("{:<16} {:>10} {:>12} {:>9} {:>9} {:>9}   ({} scans later, within {} m)",
                            "detector", "per scan", "found again", "matched", "mean mm", "rms mm", words.gap,
                            words.within_m));
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t d = 0; d < harvest.found.size(); ++d) {
    const std::string name(to_string(harvest.found[d].detector));
    const double per_scan = static_cast<double>(harvest.found[d].count) / scans;
    nlohmann::json row{{"detector", name}, {"keypoints", harvest.found[d].count}, {"per_scan", per_scan}};
    if (again.empty()) {
      console.say(fmt::format("{:<16} {:>10.2f}", name, per_scan));
    } else {
      const eval::Repeatability& r = again[d];
      console.say(fmt::format("{:<16} {:>10.2f} {:>12.3f} {:>9.3f} {:>9.1f} {:>9.1f}", name, per_scan,
                              r.found_ratio(), r.matched_ratio(), 1e3 * r.mean_distance_m(),
                              1e3 * r.rms_distance_m()));
      row["repeatability"] = {{"gap", words.gap},
                              {"within_m", words.within_m},
                              {"found_ratio", r.found_ratio()},
                              {"matched_ratio", r.matched_ratio()},
                              {"mean_distance_m", r.mean_distance_m()},
                              {"rms_distance_m", r.rms_distance_m()}};
    }
    rows.push_back(row);
  }
  console.result({{"scans", harvest.scan_indices.size()}, {"detectors", rows}});
}

/// Refuses to write over what is read, or two things into one file.
Result<Done> check_outputs(const FeaturesWords& words) {
  const auto same = [](const std::string& p, const std::string& q) {
    std::error_code none;
    return !p.empty() && !q.empty() && (p == q || std::filesystem::equivalent(p, q, none));
  };
  for (const std::string& out : {words.csv, words.plot})
    if (same(out, words.recording) || same(out, words.reference))
      return Error{out, "this file is read, and would be written over",
                   "give --csv and --plot files of their own"};
  if (same(words.csv, words.plot)) return Error{words.csv, "--csv and --plot are the same file", "give two"};
  return Done{};
}

}  // namespace

int features_run(const Console& console, const FeaturesWords& words) {
  // 1. What was asked for.
  const auto wanted = detectors_of(words);
  if (!wanted) return console.fail(wanted.error(), exit_usage);
  const auto config = config_of(words);
  if (!config) return console.fail(config.error(), exit_usage);
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  if (!words.sweep.empty() && words.plot.empty())
    return console.fail({"--sweep", "there is no file to draw into", "give --plot FILE.svg"}, exit_usage);
  if (auto outputs = check_outputs(words); !outputs) return console.fail(outputs.error(), exit_usage);
  // 2. Detect.
  ProblemLog problems;
  const auto recording = open_recording(words.recording, words.scan, problems);
  if (!recording) return console.fail(recording.error());
  const Harvest harvest = harvest_of(console, *recording, *scans, words, *wanted, *config);
  problems.report(console);
  if (harvest.scan_indices.empty())
    return console.fail({words.recording, "there is no scan to look at", "see beaconless info, and --scans"});
  // 3. Write.
  if (!words.csv.empty())
    if (auto written = io::write_whole_file(words.csv, harvest.csv); !written)
      return console.fail(written.error());
  if (!words.plot.empty()) {
    if (!harvest.plotted)
      return console.fail(
          {"--scan " + std::to_string(words.plotted_scan), "that scan is not among those taken",
           fmt::format("take one of {} … {}", harvest.scan_indices.front(), harvest.scan_indices.back())},
          exit_usage);
    const std::string name = fmt::format(
        "{}, scan {}", std::filesystem::path(words.recording).filename().string(), harvest.plotted_index);
    const std::string svg = words.sweep.empty() ? features_picture(*harvest.plotted, *wanted, *config, name)
                                                : sweep_picture(*harvest.plotted, *config, name);
    if (auto written = io::write_whole_file(words.plot, svg); !written) return console.fail(written.error());
  }
  // 4. Say what it is worth.
  std::vector<eval::Repeatability> again;
  if (!words.reference.empty()) {
    ProblemLog pose_problems;
    auto all = repeatabilities(words, *recording, harvest, pose_problems);
    pose_problems.report(console);
    if (!all) return console.fail(all.error());
    again = *std::move(all);
  }
  say(console, words, harvest, again);
  return exit_good;
}

}  // namespace beaconless::cli
