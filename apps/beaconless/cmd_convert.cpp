// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/recording_writer.hpp"

#include "commands.hpp"
#include "words.hpp"

namespace beaconless::cli {
namespace {

struct ConvertWords {
  std::string from;
  std::string to;
  ScanWords scan;
  std::string compression = "zstd";
};

/// What went from one file into the other.
struct Copied {
  std::uint64_t scans = 0;
  std::uint64_t odometry = 0;
  std::uint64_t poses = 0;
  std::uint64_t skipped = 0;
  std::optional<Pose2> base_from_laser;  ///< the first that was told, which no format has room for
};

io::McapCompression compression_of(const std::string& word) {
  return word == "none"  ? io::McapCompression::none
         : word == "lz4" ? io::McapCompression::lz4
                         : io::McapCompression::zstd;
}

Copied copy(const io::Recording& from, const io::ScanSelection& scans, io::RecordingWriter& to) {
  Copied copied;
  if (const auto& place = from.laser_place()) copied.base_from_laser = place->base_from_laser;
  std::uint64_t index = 0;
  const auto pass = from.open_pass();
  while (to.good()) {
    const auto event = pass->next();
    if (!event) break;
    if (std::holds_alternative<Scan>(*event)) {
      if (!scans.wants(index++)) continue;
      ++copied.scans;
    } else if (const auto* reference = std::get_if<ReferencePose>(&*event)) {
      ++copied.poses;
      if (reference->base_from_laser && !copied.base_from_laser)
        copied.base_from_laser = reference->base_from_laser;
    } else {
      ++copied.odometry;
    }
    to.write(*event);
  }
  copied.skipped = pass->skipped();
  return copied;
}

int convert(const Console& console, const ConvertWords& words) {
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  ProblemLog problems;
  problems.listening = false;
  const auto from = open_recording(words.from, words.scan, problems);
  if (!from) return console.fail(from.error());
  std::error_code ignored;
  if (std::filesystem::equivalent(words.from, words.to, ignored))
    return console.fail({words.to, "is the recording itself", "give the copy another name"}, exit_usage);
  auto to = io::make_recording_writer(
      words.to, {.scan_topic = from->scan_topic(), .compression = compression_of(words.compression)});
  if (!to) return console.fail(to.error());

  problems.listening = true;
  const Copied copied = copy(*from, *scans, *to.value());
  problems.report(console);
  if (auto written = to.value()->finish(); !written) return console.fail(written.error());
  if (copied.base_from_laser)
    console.note(
        fmt::format("where the laser sits on the robot has no place in the copy: "
                    "--base-from-laser {:.3f},{:.3f},{:.1f}",
                    copied.base_from_laser->x_m, copied.base_from_laser->y_m,
                    degrees(copied.base_from_laser->theta_rad)));
  const auto bytes = std::filesystem::file_size(words.to, ignored);
  console.say(fmt::format("{}: {} scans, {} odometry readings, {} poses, {:.1f} MB", words.to, copied.scans,
                          copied.odometry, copied.poses, static_cast<double>(bytes) * 1e-6));
  console.result({{"out", words.to},
                  {"scans", copied.scans},
                  {"odometry", copied.odometry},
                  {"poses", copied.poses},
                  {"skipped", copied.skipped},
                  {"bytes", bytes}});
  return exit_good;
}

}  // namespace

void add_convert(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("convert", "Write a recording in another format");
  auto words = std::make_shared<ConvertWords>();
  command->add_option("from", words->from, "The recording, of any format that is read")->required();
  command->add_option("to", words->to, "The copy; its name decides: .mcap, .log, .log.gz (CARMEN)")
      ->required();
  command->add_option("--topic", words->scan.topic, "Which scans: a topic of a bag, a keyword of a log");
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  command->add_option("--compression", words->compression, "How the chunks of an MCAP file are packed")
      ->check(CLI::IsMember({"none", "lz4", "zstd"}))
      ->capture_default_str();
  command->footer("Example:  beaconless convert drive.bag drive.mcap --topic /scan");
  command->callback([&console, &exit_code, words] { exit_code = convert(console, *words); });
}

}  // namespace beaconless::cli
