// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/inspect.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/topic_choice.hpp"

#include "commands.hpp"
#include "laser_words.hpp"

namespace beaconless::cli {
namespace {

struct InfoWords {
  std::string path;
  std::string topic;
};

bool is_map(const std::string& path) { return path.ends_with(".yaml") || path.ends_with(".yml"); }

nlohmann::json describe_map(const Console& console, const FloorPlan& plan) {
  const auto segments = plan.segments();
  const auto bounds = plan.bounds();
  double length_m = 0.0;
  for (const Segment2& segment : segments) length_m += segment.length_m();
  console.say(fmt::format(
      "floor plan: {} walls in {} lines, {:.1f} m in all, x {:.2f} … {:.2f} m, y {:.2f} … {:.2f} m",
      segments.size(), plan.walls.size(), length_m, bounds.low.x(), bounds.high.x(), bounds.low.y(),
      bounds.high.y()));
  return {{"kind", "floor plan"},
          {"walls", segments.size()},
          {"length_m", length_m},
          {"low_m", {bounds.low.x(), bounds.low.y()}},
          {"high_m", {bounds.high.x(), bounds.high.y()}}};
}

nlohmann::json describe_map(const Console& console, const OccupancyGrid& grid) {
  std::size_t occupied = 0;
  std::size_t free = 0;
  for (int y = 0; y < grid.height_cells; ++y) {
    for (int x = 0; x < grid.width_cells; ++x) {
      occupied += grid.is_occupied({x, y}) ? 1 : 0;
      free += grid.is_free({x, y}) ? 1 : 0;
    }
  }
  const Pose2& origin = grid.map_from_grid;
  console.say(fmt::format(
      "occupancy grid: {} x {} cells of {} m ({:.1f} x {:.1f} m), origin {:.3f}, {:.3f} m, {:.3f} deg",
      grid.width_cells, grid.height_cells, grid.resolution_m, grid.width_cells * grid.resolution_m,
      grid.height_cells * grid.resolution_m, origin.x_m, origin.y_m, degrees(origin.theta_rad)));
  console.say(fmt::format("cells: {} occupied, {} free, {} unknown or between", occupied, free,
                          grid.occupancy_percent.size() - occupied - free));
  return {{"kind", "occupancy grid"},
          {"width_cells", grid.width_cells},
          {"height_cells", grid.height_cells},
          {"resolution_m", grid.resolution_m},
          {"origin", {origin.x_m, origin.y_m, origin.theta_rad}},
          {"occupied", occupied},
          {"free", free}};
}

int map_info(const Console& console, const std::string& path) {
  const auto map = io::read_map(path);
  if (!map) return console.fail(map.error());
  console.result(std::visit([&](const auto& kind) { return describe_map(console, kind); }, *map));
  return exit_good;
}

nlohmann::json to_json(const io::PoseSource& source) {
  return {{"name", source.name}, {"count", source.count}, {"length_m", source.path_length_m}};
}

void say_recording(const Console& console, const io::RecordingSummary& s) {
  console.say(fmt::format("{}: {}", s.path, s.format));
  for (const io::Topic& topic : s.topics)
    console.say(fmt::format("  {:<44} {:<36} {:>8}{}", topic.name, topic.type, topic.count,
                            topic.name == s.scan_topic ? "  <- read" : ""));
  if (s.scans > 0) {
    console.say(fmt::format("scans    {} in {:.1f} s, {:.2f} Hz, from {}", s.scans, s.duration_s, s.rate_hz,
                            to_string(s.first_stamp)));
    console.say(fmt::format(
        "beams    {}{}, from {:.2f} deg over {:.2f} deg by {:.4f} deg, {} … {} m", s.least_beams,
        s.most_beams != s.least_beams ? fmt::format(" … {}", s.most_beams) : "", degrees(s.angle_min_rad),
        degrees(s.field_of_view_rad), degrees(s.angle_increment_rad), s.range_min_m, s.range_max_m));
    console.say(
        fmt::format("of them  {:.1f} % hits, {:.1f} % no return, {:.1f} % too close, {:.1f} % invalid",
                    100 * s.share(s.hits), 100 * s.share(s.no_returns), 100 * s.share(s.too_close),
                    100 * s.share(s.invalid)));
  }
  if (s.laser_place) console.say("laser    " + laser_words(*s.laser_place));
  for (const io::PoseSource& source : s.references)
    console.say(fmt::format("poses    {}: {}, {:.1f} m", source.name, source.count, source.path_length_m));
  for (const io::PoseSource& source : s.odometry)
    console.say(fmt::format("odometry {}: {}, {:.1f} m", source.name, source.count, source.path_length_m));
  if (s.skipped_records > 0)
    console.say(fmt::format("skipped  {} records that could not be read", s.skipped_records));
}

nlohmann::json to_json(const io::RecordingSummary& s) {
  nlohmann::json topics = nlohmann::json::array();
  for (const io::Topic& topic : s.topics)
    topics.push_back({{"name", topic.name}, {"type", topic.type}, {"count", topic.count}});
  nlohmann::json references = nlohmann::json::array();
  for (const auto& source : s.references) references.push_back(to_json(source));
  nlohmann::json odometry = nlohmann::json::array();
  for (const auto& source : s.odometry) odometry.push_back(to_json(source));
  nlohmann::json laser = nullptr;
  if (s.laser_place) {
    const Pose2& at = s.laser_place->base_from_laser;
    laser = {at.x_m, at.y_m, at.theta_rad};
  }
  nlohmann::json range_max = nullptr;
  if (std::isfinite(s.range_max_m)) range_max = s.range_max_m;
  return {{"kind", "recording"},
          {"format", s.format},
          {"scan_topic", s.scan_topic},
          {"base_from_laser", laser},
          {"topics", topics},
          {"scans", s.scans},
          {"duration_s", s.duration_s},
          {"rate_hz", s.rate_hz},
          {"beams", s.most_beams},
          {"angle_min_rad", s.angle_min_rad},
          {"angle_increment_rad", s.angle_increment_rad},
          {"range_min_m", s.range_min_m},
          {"range_max_m", range_max},
          {"hits", s.hits},
          {"no_returns", s.no_returns},
          {"too_close", s.too_close},
          {"invalid", s.invalid},
          {"references", references},
          {"odometry", odometry},
          {"skipped_records", s.skipped_records}};
}

Result<io::RecordingSummary> summary_of(const InfoWords& words, ProblemLog& problems) {
  const auto recording = io::open_recording(
      words.path, {.topic = words.topic, .scans_optional = true, .on_problem = [&](const io::Problem& p) {
                     problems.add(p);
                   }});
  if (!recording) return recording.error();
  return io::summarize(*recording);
}

int info(const Console& console, const InfoWords& words) {
  if (is_map(words.path)) return map_info(console, words.path);
  ProblemLog problems;
  const auto summary = summary_of(words, problems);
  if (!summary) return console.fail(summary.error());
  problems.report(console);
  say_recording(console, *summary);
  if (summary->scan_topic.empty() && summary->scans == 0)
    console.say("no scans were read; where there are several topics with scans, choose one with --topic");
  nlohmann::json told = to_json(*summary);
  told["problems"] = problems.lines();
  console.result(told);
  return exit_good;
}

/// The scan topics of a recording of which none was chosen, because there are several.
std::vector<std::string> topics_to_choose_from(const io::Recording& recording) {
  std::vector<std::string> topics;
  if (!recording.scan_topic().empty()) return topics;
  for (const io::Topic& topic : recording.topics())
    if (io::is_scan_topic(topic)) topics.push_back(topic.name);
  return topics;
}

nlohmann::json say_findings(const Console& console, const std::vector<io::Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const io::Finding& finding : findings) {
    const bool grave = finding.weight == io::Finding::Weight::warning;
    console.say(fmt::format("{} {}{}", grave ? "!" : "-", finding.what,
                            finding.remedy.empty() ? "" : "\n    -> " + finding.remedy));
    list.push_back(
        {{"weight", grave ? "warning" : "note"}, {"what", finding.what}, {"remedy", finding.remedy}});
  }
  return list;
}

/// The findings of one topic of scans.
Result<nlohmann::json> examine(const Console& console, const InfoWords& words) {
  ProblemLog problems;
  const auto summary = summary_of(words, problems);
  if (!summary) return summary.error();
  problems.report(console);
  const auto findings = io::diagnose(*summary);
  if (findings.empty() && problems.count() == 0) console.say("nothing unusual");
  return nlohmann::json{{"findings", say_findings(console, findings)}, {"problems", problems.lines()}};
}

int doctor(const Console& console, const InfoWords& words) {
  if (is_map(words.path)) return map_info(console, words.path);
  const auto first = io::open_recording(words.path, {.topic = words.topic, .scans_optional = true});
  if (!first) return console.fail(first.error());
  const auto topics = topics_to_choose_from(*first);
  if (topics.empty()) {
    const auto found = examine(console, words);
    if (!found) return console.fail(found.error());
    console.result(*found);
    return exit_good;
  }
  nlohmann::json all;
  bool is_any = false;
  for (const std::string& topic : topics) {
    console.say(topic + ":");
    auto found = examine(console, {words.path, topic});
    if (!found) console.say("! " + to_string(found.error()));
    is_any = is_any || found;
    all[topic] = found ? *std::move(found) : nlohmann::json{{"error", to_string(found.error())}};
  }
  console.result({{"topics", all}});
  return is_any ? exit_good : exit_data;
}

using Verb = int (*)(const Console&, const InfoWords&);

void add_verb(CLI::App& app, const char* name, const char* sentence, Verb verb, Console& console,
              int& exit_code) {
  auto* command = app.add_subcommand(name, sentence);
  auto words = std::make_shared<InfoWords>();
  command->add_option("path", words->path, "A recording, or the YAML of a map")->required();
  command->add_option("--topic", words->topic, "Which scans: a topic of a bag, a keyword of a log");
  command->callback([&console, &exit_code, words, verb] { exit_code = verb(console, *words); });
}

}  // namespace

void add_info(CLI::App& app, Console& console, int& exit_code) {
  add_verb(app, "info", "Summarise a recording or a map", info, console, exit_code);
}

void add_doctor(CLI::App& app, Console& console, int& exit_code) {
  add_verb(app, "doctor", "Explain in words what is unusual or wrong with a recording", doctor, console,
           exit_code);
}

}  // namespace beaconless::cli
