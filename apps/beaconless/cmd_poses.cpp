// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/tum.hpp"

#include "commands.hpp"
#include "poses_of.hpp"

namespace beaconless::cli {
namespace {

struct PosesWords {
  std::string recording;
  std::string topic;
  std::string out;
};

int poses(const Console& console, const PosesWords& words) {
  ProblemLog problems;
  const auto recording = io::open_recording(
      words.recording,
      {.scans_optional = true, .on_problem = [&](const io::Problem& problem) { problems.add(problem); }});
  if (!recording) return console.fail(recording.error());
  const auto found = poses_of("recorded", *recording, words.topic, problems);
  problems.report(console);
  if (!found) return console.fail(found.error());
  if (auto written = io::write_tum(words.out, found->trajectory); !written)
    return console.fail(written.error());
  console.say(fmt::format("{}: {} poses of {}, {:.1f} m", words.out, found->trajectory.size(), found->source,
                          found->trajectory.length_m()));
  console.result({{"out", words.out},
                  {"source", found->source},
                  {"poses", found->trajectory.size()},
                  {"length_m", found->trajectory.length_m()}});
  return exit_good;
}

}  // namespace

void add_poses(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("poses", "Write the poses that a recording itself carries");
  auto words = std::make_shared<PosesWords>();
  command->add_option("recording", words->recording, "The recording")->required();
  command->add_option("--topic", words->topic, "The source: a topic of a bag, a keyword of a log");
  command->add_option("--out", words->out, "The TUM file to write")->required();
  command->footer("Example:  beaconless poses drive.log --out reference.tum");
  command->callback([&console, &exit_code, words] { exit_code = poses(console, *words); });
}

}  // namespace beaconless::cli
