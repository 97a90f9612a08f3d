// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/eval/nees.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/tum.hpp"

#include "commands.hpp"
#include "evaluate_relations.hpp"
#include "tables.hpp"
#include "words.hpp"

namespace beaconless::cli {
namespace {

struct EvaluateWords {
  std::string estimate;
  std::string reference;
  bool align = false;
  std::string map;
  double sigma_m = 0.01;
  std::string recording;
  std::string topic;
  std::string base_from_laser = "0,0,0";
  double max_gap_s = 1.0;
  RelationWords relations;
};

/// What keeps an option's text from being a finite number; "" when nothing does.
std::string not_finite(const std::string& text) {
  const auto number = parse_double(text);
  return number && std::isfinite(*number) ? "" : "\"" + text + "\" is no finite number";
}

bool is_csv(const std::string& path) { return path.ends_with(".csv"); }

/// The scanner of a recording's first scan, or the UTM-30LX where no recording is given.
Result<eval::RangeSensor> sensor_of(const EvaluateWords& words) {
  if (words.recording.empty()) return eval::utm_30lx(words.sigma_m);
  const auto recording = io::open_recording(words.recording, {.topic = words.topic});
  if (!recording) return recording.error();
  for (const Event& event : *recording)
    if (const auto* scan = std::get_if<Scan>(&event)) return eval::sensor_of(*scan, words.sigma_m);
  return Error{words.recording, "the recording has no scans", ""};
}

int evaluate(const Console& console, const EvaluateWords& words) {
  const bool by_relations = !words.relations.relations.empty();
  if (by_relations == !words.reference.empty())
    return console.fail({"evaluate", by_relations ? "there are two references" : "there is no reference",
                         "give a TUM file of reference poses, or --relations FILE"},
                        exit_usage);
  ProblemLog problems;
  const auto on_problem = [&](const io::Problem& problem) { problems.add(problem); };
  // 1. Read the trajectory and what it is compared with.
  std::vector<PoseEstimate> estimates;
  Trajectory estimate;
  if (is_csv(words.estimate)) {
    auto rows = io::read_estimates_csv(words.estimate, on_problem);
    if (!rows) return console.fail(rows.error());
    estimates = *rows;
    for (const PoseEstimate& row : estimates) estimate.add(row.stamp, row.map_from_base);
  } else {
    auto trajectory = io::read_tum(words.estimate, on_problem);
    if (!trajectory) return console.fail(trajectory.error());
    estimate = *trajectory;
  }
  if (by_relations) {
    problems.report(console);
    RelationWords relations = words.relations;
    relations.estimate = words.estimate;
    relations.recording = words.recording;
    relations.topic = words.topic;
    return evaluate_relations(console, relations, estimate);
  }
  const auto reference = io::read_tum(words.reference, on_problem);
  if (!reference) return console.fail(reference.error());
  // 2. Read what the accuracy bound needs.
  std::optional<Map> map;
  if (!words.map.empty()) {
    auto read = io::read_map(words.map);
    if (!read) return console.fail(read.error());
    map = *read;
  }
  const auto sensor = sensor_of(words);
  if (!sensor) return console.fail(sensor.error());
  const auto base_from_laser = pose_from_words("--base-from-laser", words.base_from_laser);
  if (!base_from_laser) return console.fail(base_from_laser.error(), exit_usage);
  // 3. Compare.
  const Judgement judgement =
      judge(estimate, *reference, map ? &*map : nullptr, *sensor, *base_from_laser, words.max_gap_s);
  problems.report(console);
  if (judgement.evaluation.errors.empty())
    return console.fail({words.estimate, "no estimate has a reference at its stamp",
                         "check that both files use the same clock; --max-gap widens what is interpolated"});
  // 4. Tell.
  nlohmann::json object = to_json(judgement);
  console.say(fmt::format("{} pairs, {} estimates without a reference", judgement.evaluation.errors.size(),
                          judgement.evaluation.unmatched_count));
  console.say(table_text(judgement.evaluation.raw));
  if (words.align) console.say("after rigid alignment\n" + table_text(judgement.evaluation.aligned));
  if (judgement.crb_ratio)
    console.say(fmt::format(
        "{:.3f} (position) and {:.3f} (heading) times the Cramér–Rao bound{}", judgement.crb_ratio->position,
        judgement.crb_ratio->heading,
        words.recording.empty() ? " of a UTM-30LX; --recording takes the scanner from there" : ""));
  if (!estimates.empty()) {
    const eval::Consistency consistency = eval::consistency_of(estimates, *reference, words.max_gap_s);
    console.say(fmt::format("covariance: {}; mean NEES {:.2f}, honest between {:.2f} and {:.2f}",
                            consistency.verdict(), consistency.mean_nees, consistency.low, consistency.high));
    object["nees"] = {{"mean", consistency.mean_nees}, {"low", consistency.low}, {"high", consistency.high}};
  }
  console.result(object);
  return exit_good;
}

}  // namespace

void add_evaluate(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("evaluate", "Compare a trajectory with a reference");
  auto words = std::make_shared<EvaluateWords>();
  command
      ->add_option("estimate", words->estimate,
                   "Estimated poses: a TUM file, or estimates.csv (checks the covariance too)")
      ->required();
  command->add_option("reference", words->reference, "Reference poses: a TUM file");
  command->add_option("--relations", words->relations.relations,
                      "In the place of a reference: known relations between pairs of poses (t1 t2 x y z "
                      "roll pitch yaw, or i j x y theta with numbers of scans)");
  command
      ->add_option("--clock-offset", words->relations.clock_offset_s,
                   "Seconds by which the relations' clock is ahead of the estimate's")
      ->check(not_finite, "NUMBER")
      ->capture_default_str();
  command
      ->add_option("--tolerance", words->relations.tolerance_s,
                   "How far from a relation's stamp its pose may be [s]")
      ->check(not_from_zero_on, "NUMBER >= 0")
      ->capture_default_str();
  command->add_flag("--align", words->align, "Print the errors after rigid alignment too");
  command->add_option("--map", words->map, "Floor plan, for the Cramér–Rao bound");
  command
      ->add_option("--sigma", words->sigma_m, "Standard deviation of the laser's ranges [m], for the bound")
      ->check(not_positive, "NUMBER > 0")
      ->capture_default_str();
  command->add_option("--recording", words->recording,
                      "Recording whose scanner the bound is for (default: UTM-30LX), or whose scans "
                      "relations count");
  command->add_option("--topic", words->topic, "Its scan topic");
  command->add_option("--base-from-laser", words->base_from_laser, "Laser on the robot, x,y,deg")
      ->capture_default_str();
  command->add_option("--max-gap", words->max_gap_s, "Longest gap of the reference that is interpolated [s]")
      ->check(not_positive, "NUMBER > 0")
      ->capture_default_str();
  command->footer(
      "Example:  beaconless evaluate run/trajectory.tum truth.tum --align --map plan.yaml --sigma 0.01");
  command->callback([&console, &exit_code, words] { exit_code = evaluate(console, *words); });
}

}  // namespace beaconless::cli
