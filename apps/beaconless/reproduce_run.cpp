// SPDX-License-Identifier: Apache-2.0
#include "reproduce_run.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "beaconless/io/whole_file.hpp"

#include "reproduce_figures.hpp"
#include "reproduction.hpp"
#include "run_files.hpp"

namespace beaconless::cli {
namespace {

constexpr int kQuickTapes = 1;
constexpr int kTimedPasses = 5;

Result<Reproduction> reproduce(const Console& console, const ReproduceWords& words, MethodList methods) {
  Reproduction r{.tape_seed = words.tape_seed, .is_quick = words.is_quick, .methods = std::move(methods)};
  console.note(fmt::format("1. {} scenarios are simulated", reproduced_scenarios().size()));
  auto scenes = simulate_scenes(console, words.tape_seed, words.is_quick);
  if (!scenes) return scenes.error();
  r.scenes = *std::move(scenes);
  console.note(fmt::format("2. {} methods localize each of them on {} maps", r.methods.present.size(),
                           kMapKinds.size()));
  r.experiments = run_experiments(console, r.scenes, r.methods.present);
  r.comparisons = compare(r.experiments);
  const int tapes = words.is_quick ? kQuickTapes : words.tapes;
  console.note(fmt::format("3. The rooms of the tables are measured by {} more tapes", tapes));
  r.tapes = run_tapes(console, r.scenes, r.methods.present, words.tape_seed + 1, tapes);
  console.note("4. Segmentation is timed");
  r.times =
      time_segmentation(scene_named(r.scenes, "room-position-2").run, words.is_quick ? 1 : kTimedPasses);
  return r;
}

}  // namespace

int reproduce_run(const Console& console, const ReproduceWords& words) {
  auto methods = reproduced_methods(words.methods);
  if (!methods) return console.fail(methods.error(), exit_usage);
  const auto folder = RunFolder::make(words.out);
  if (!folder) return console.fail(folder.error());
  const auto r = reproduce(console, words, *std::move(methods));
  if (!r) return console.fail(r.error());
  console.note("5. The report is written");
  auto files = csv_files(*r);
  files.push_back({"summary.md", markdown(*r)});
  files.push_back({"report.html", html(*r)});
  nlohmann::json paths = nlohmann::json::array();
  for (const TextFile& file : files) {
    const std::string path = (std::filesystem::path(words.out) / file.name).string();
    if (auto written = io::write_whole_file(path, file.text); !written) return console.fail(written.error());
    paths.push_back(path);
  }
  for (const std::string& finding : findings_of(*r)) console.say(finding + "\n");
  console.say("open this in a browser:  " +
              std::filesystem::absolute(words.out + "/report.html").lexically_normal().string());
  const Score score = score_of(r->comparisons);
  console.result({{"methods", r->methods.present},
                  {"left_out", r->methods.left_out},
                  {"compared", score.compared},
                  {"at_or_below", score.at_or_below},
                  {"files", paths}});
  return exit_good;
}

}  // namespace beaconless::cli
