// SPDX-License-Identifier: Apache-2.0
// Whether the status of a pose deserves trust: runs in which the map is wrong, people stand in the way, the
// robot is carried, and recordings. One line of JSON a case; tools/measure-trust makes tables of them.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "bench/trust/follow.hpp"
#include "bench/trust/kidnapping.hpp"
#include "bench/trust/recorded_trials.hpp"
#include "bench/trust/simulated_trial.hpp"
#include "bench/trust/tell.hpp"

namespace {

using namespace beaconless;

constexpr std::uint64_t kHeldOut = 300'000;  // seeds from here on are not looked at while anything is tuned

struct StudyWords {
  std::string study = "simulations";
  std::string method = "walls";
  std::string cases;
  std::vector<std::string> kinds;
  bool held_out = false;
  bool verbose = false;
};

/// Cases from one to before another, counted from 1.
struct CaseRange {
  std::size_t first = 1;
  std::size_t end = 0;
};

CaseRange range_of(const std::string& text, std::size_t all) {
  if (text.empty()) return {1, all + 1};
  const std::size_t colon = text.find(':');
  const std::size_t first = std::stoul(text);
  return {first, colon == std::string::npos ? first + 1 : std::stoul(text.substr(colon + 1))};
}

bool is_wanted(const StudyWords& words, std::string_view kind) {
  return words.kinds.empty() || std::find(words.kinds.begin(), words.kinds.end(), kind) != words.kinds.end();
}

void run_trial(const StudyWords& words, std::size_t number, const trust::Trial& trial) {
  const auto records = trust::follow(trial, words.method);
  if (words.verbose) trust::trace(std::cout, records);
  trust::tell(std::cout, number, trial,
              trust::tally(records, {.is_followed = trial.starts.size() == 1,
                                     .reference_m = trial.reference_m,
                                     .reference_rad = trial.reference_rad}));
}

void run_simulations(const StudyWords& words) {
  const CaseRange range = range_of(words.cases, 500);
  for (std::size_t i = range.first; i < range.end; ++i) {
    const std::uint64_t seed = i + (words.held_out ? kHeldOut : 0);
    if (is_wanted(words, trust::kKinds[static_cast<std::size_t>(trust::kind_of(seed))]))
      run_trial(words, i, trust::simulated_trial(seed));
  }
}

void run_recordings(const StudyWords& words) {
  const auto recordings = trust::recorded_trials();
  const CaseRange range = range_of(words.cases, recordings.size());
  for (std::size_t i = range.first; i < range.end && i <= recordings.size(); ++i)
    if (is_wanted(words, recordings[i - 1].name)) run_trial(words, i, recordings[i - 1].read());
}

void run_kidnappings(const StudyWords& words) {
  const CaseRange range = range_of(words.cases, 200);
  trust::Kidnapper kidnapper;
  for (std::size_t i = range.first; i < range.end; ++i) {
    const trust::Kidnapping made = kidnapper.kidnapping(i + (words.held_out ? kHeldOut : 0));
    if (!is_wanted(words, made.trial.family)) continue;
    const auto records = trust::follow(made.trial, words.method);
    if (words.verbose) {
      std::cout << "carried before scan " << made.carried_at << "\n";
      trust::trace(std::cout, records);
    }
    trust::CarryVerdict verdict = trust::judge(made, records);
    verdict.is_unambiguous = trust::is_unambiguous(made, words.method);
    trust::tell(std::cout, i, made, verdict);
  }
}

int run(int argc, char** argv) {
  StudyWords words;
  CLI::App app{"Measures how far the status of a pose deserves trust; a line of JSON a case."};
  app.add_option("study", words.study, "What to run")
      ->check(CLI::IsMember({"simulations", "kidnappings", "recordings"}));
  app.add_option("--cases,--case", words.cases, "A:B, from A to before B, or one alone");
  app.add_option("--kinds", words.kinds, "Only these kinds, or recordings, or families of kidnappings")
      ->delimiter(',');
  app.add_option("--method", words.method, "Of the localizer");
  app.add_flag("--held-out", words.held_out,
               "Seeds from " + std::to_string(kHeldOut) + " on, which nothing was tuned to");
  app.add_flag("--verbose", words.verbose, "A line a scan");
  CLI11_PARSE(app, argc, argv);
  if (words.study == "simulations") run_simulations(words);
  if (words.study == "kidnappings") run_kidnappings(words);
  if (words.study == "recordings") run_recordings(words);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "trust_study: %s\n", error.what());
    return 3;
  }
}
