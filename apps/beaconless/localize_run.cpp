// SPDX-License-Identifier: Apache-2.0
#include "localize_run.hpp"

#include <fmt/format.h>

#include "beaconless/io/mcap_events.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "laser_words.hpp"
#include "localize_inputs.hpp"
#include "localize_plan.hpp"
#include "localizer_config_of.hpp"
#include "resume.hpp"
#include "resuming_localizer.hpp"
#include "run_files.hpp"
#include "run_watch.hpp"
#include "window_outcomes.hpp"

namespace beaconless::cli {
namespace {

/// The reference at every scan: its own where its line tells one, because stamps of logs may repeat.
Trajectory reference_of(const Replay& replay, const PosesOf& poses) {
  if (poses.by_scan.empty()) return poses.trajectory;
  Trajectory reference;
  for (std::size_t i = 0; i < replay.estimates.size(); ++i)
    if (const auto pose = poses.at(replay.scan_indices[i], replay.estimates[i].stamp))
      reference.add(replay.estimates[i].stamp, *pose);
  return reference;
}

/// What was asked for, with the laser where the recording says that it sits unless it was told here.
LocalizePlan placed(LocalizePlan plan, const LocalizeWords& words, const io::Recording& recording,
                    const std::vector<LaserOnRobot>& lasers, const Console& console) {
  plan.config.lasers = lasers;
  const auto& told = recording.laser_place();
  const bool is_told_here = !words.base_from_laser.empty() || !words.config.empty() || !lasers.empty();
  if (!told && !is_told_here && plan.config.base_from_laser == Pose2{})
    console.note(
        "where the laser sits on the robot is not told: the poses are those of the laser itself; "
        "--base-from-laser x,y,deg tells it");
  if (!told || !words.base_from_laser.empty() || plan.config.base_from_laser != Pose2{}) return plan;
  console.note(laser_words(*told));
  plan.config.base_from_laser = told->base_from_laser;
  return plan;
}

/// Takes every window by itself; its estimate is that of its last scan.
void localize_windows(const LocalizePlan& plan, const LocalizeInputs& inputs, Localizer& localizer,
                      const Console& console, Run& run) {
  const WindowsReplay all = replay_windows(inputs.recording, plan.scans, localizer,
                                           std::get<StartAnywhere>(inputs.start), *plan.windows, console);
  for (const WindowFound& window : all.windows) {
    run.replay.estimates.push_back(window.estimate);
    run.replay.scan_indices.push_back(window.last_scan);
    run.replay.update_us.push_back(window.took_us / static_cast<double>(plan.windows->length));
  }
  run.replay.skipped_records = all.skipped_records;
  const auto judged = judge_windows(all.windows, inputs.reference ? &*inputs.reference : nullptr);
  run.windows = WindowFiles{summary_of(judged, *plan.windows), lines_of(judged, inputs.reference.has_value()),
                            csv_of(judged)};
}

std::string words_of(const Pose2& pose) {
  return fmt::format("{},{},{}", pose.x_m, pose.y_m, degrees(pose.theta_rad));
}

/// A localizer that is started, and the words that begin the same run again.
struct Begun {
  std::unique_ptr<Localizer> localizer;
  std::string start;
};

Result<Begun> begun(std::unique_ptr<Localizer> localizer, const LocalizeWords& words,
                    const LocalizeInputs& inputs, const io::MapIdentity& map, const Console& console) {
  if (const auto* here = std::get_if<StartHere>(&inputs.start)) {
    localizer->start_at(here->map_from_base);
    return Begun{std::move(localizer), words.start.empty() ? words_of(here->map_from_base) : words.start};
  }
  if (const auto* anywhere = std::get_if<StartAnywhere>(&inputs.start)) {
    localizer->start_anywhere(anywhere->within);
    return Begun{std::move(localizer), words.start};
  }
  const auto pose =
      resumed_pose(console, std::get<StartResumed>(inputs.start).pose_file, map, inputs.first.scan.stamp());
  if (!pose) return pose.error();
  return Begun{std::make_unique<ResumingLocalizer>(std::move(localizer), *pose), words_of(*pose)};
}

/// Those of several lasers stay apart.
std::string topic_for_viewers(const LaserWords& words, const std::vector<LaserOnRobot>& lasers,
                              const Scan& scan) {
  for (std::size_t i = 0; i < lasers.size(); ++i)
    if (lasers[i].frame_id == scan.frame_id())
      return words.topics[i].starts_with('/') ? words.topics[i] : "/" + words.topics[i];
  return "/scan";
}

/// Takes the scans one after the other.
Result<Done> localize_drive(const LocalizeWords& words, const LocalizePlan& plan,
                            const LocalizeInputs& inputs, std::unique_ptr<Localizer> localizer,
                            const Console& console, Run& run) {
  io::MapIdentity map;
  if (!words.save_pose.empty() || !words.black_box.empty() ||
      std::holds_alternative<StartResumed>(inputs.start)) {
    auto identified = io::identify_map(words.map);
    if (!identified) return identified.error();
    map = *std::move(identified);
  }
  auto ready = begun(std::move(localizer), words, inputs, map, console);
  if (!ready) return ready.error();
  const auto [started, start] = *std::move(ready);
  RunWatch watch(console, words, plan, map, start);
  std::optional<io::McapEventWriter> mcap;
  if (!words.out_mcap.empty()) mcap.emplace(words.out_mcap);
  if (mcap && !mcap->good()) return mcap->finish().error();
  run.replay = replay(inputs.recording, plan.scans, *started, plan.config, console, inputs.start_at,
                      [&](const Event& event, const PoseEstimate& estimate) {
                        watch.update(event, estimate);
                        const auto* scan = std::get_if<Scan>(&event);
                        if (mcap && scan != nullptr)
                          mcap->write(*scan, estimate, base_from_laser_of(plan.config, scan->frame_id()),
                                      topic_for_viewers(words.lasers, plan.config.lasers, *scan));
                      });
  watch.finish();
  if (mcap)
    if (auto written = mcap->finish(); !written) return written.error();
  const auto* resuming = dynamic_cast<const ResumingLocalizer*>(started.get());
  if (resuming != nullptr && resuming->has_searched())
    console.note("the first scans do not fit at the last pose: the robot was searched everywhere");
  return Done{};
}

}  // namespace

int localize_run(const Console& console, const LocalizeWords& words) {
  // 1. What was asked for.
  if (auto config_file = check_config_file(words.config); !config_file)
    return console.fail(config_file.error());
  const auto asked = plan_of(words);
  if (!asked) return console.fail(asked.error(), exit_usage);
  // 2. Open what is to be read.
  const auto folder = RunFolder::make(words.out);
  if (!folder) return console.fail(folder.error());
  ProblemLog problems;
  const auto inputs = open_inputs(console, words, *asked, problems);
  if (!inputs) return console.fail(inputs.error());
  // 3. Localize.
  const LocalizePlan plan = placed(*asked, words, inputs->recording, inputs->lasers, console);
  const LocalizerConfig& config = plan.config;
  auto localizer = make_localizer(config, *inputs->map);
  if (!localizer && localizer.error().where == "map")
    return console.fail({words.map, localizer.error().what, localizer.error().remedy});
  if (!localizer) return console.fail(localizer.error(), exit_usage);
  Run run{.config = config, .map = inputs->map, .first_scan = inputs->first.scan};
  problems.listening = true;
  if (plan.windows) {
    localize_windows(plan, *inputs, **localizer, console, run);
  } else {
    if (auto driven = localize_drive(words, plan, *inputs, *std::move(localizer), console, run); !driven)
      return console.fail(driven.error());
  }
  if (run.replay.estimates.empty())
    return console.fail(
        plan.windows ? Error{words.recording, "it has no window of that many scans", "shorten --windows"}
                     : Error{words.recording, "its scans are gone", "did it change while it was read?"});
  if (inputs->reference) run.reference = reference_of(run.replay, *inputs->reference);
  run.problems = problems.lines();
  problems.report(console);
  // 4. Write and tell what came of it.
  return finish_run(console, words, run);
}

}  // namespace beaconless::cli
