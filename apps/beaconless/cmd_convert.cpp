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
  std::string compression;
};

/// What went from one file into the other.
struct Copied {
  std::uint64_t scans = 0;
  std::uint64_t odometry = 0;
  std::uint64_t poses = 0;
  std::uint64_t skipped = 0;
};

/// Of a file, or of all in a folder.
std::uint64_t bytes_of(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return std::filesystem::file_size(path, ignored);
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path, ignored))
    bytes += entry.file_size(ignored);
  return bytes;
}

Copied copy(const io::Recording& from, const io::ScanSelection& scans, io::RecordingWriter& to) {
  Copied copied;
  std::uint64_t index = 0;
  const auto pass = from.open_pass();
  while (to.good()) {
    const auto event = pass->next();
    if (!event) break;
    if (std::holds_alternative<Scan>(*event)) {
      if (!scans.wants(index++)) continue;
      ++copied.scans;
    } else if (std::holds_alternative<ReferencePose>(*event)) {
      ++copied.poses;
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
  io::RecordingWriterOptions options{.compression = words.compression};
  if (const auto possible = io::can_write_recording(words.to, options); !possible)
    return console.fail(possible.error(), exit_usage);
  ProblemLog problems;
  problems.listening = false;
  const auto from = open_recording(words.from, words.scan, problems);
  if (!from) return console.fail(from.error());
  std::error_code ignored;
  if (std::filesystem::equivalent(words.from, words.to, ignored))
    return console.fail({words.to, "is the recording itself", "give the copy another name"}, exit_usage);
  options.scan_topic = from->scan_topic();
  options.laser_place = from->laser_place();
  auto to = io::make_recording_writer(words.to, options);
  if (!to) return console.fail(to.error());

  problems.listening = true;
  const Copied copied = copy(*from, *scans, *to.value());
  problems.report(console);
  if (auto written = to.value()->finish(); !written) return console.fail(written.error());
  const std::uint64_t bytes = bytes_of(words.to);
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
  command
      ->add_option(
          "to", words->to,
          "The copy; its name decides: .mcap, .db3 or folder/ (ROS 2 bag), .bag (ROS 1 bag), .log or "
          ".log.gz (CARMEN)")
      ->required();
  command->add_option("--topic", words->scan.topic, "Which scans: a topic of a bag, a keyword of a log");
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  command->add_option("--compression", words->compression,
                      "How its chunks are packed: MCAP zstd (default), lz4, none; ROS 1 bag lz4 (default), "
                      "bz2, none");
  command->footer("Example:  beaconless convert drive.bag drive.mcap --topic /scan");
  command->callback([&console, &exit_code, words] { exit_code = convert(console, *words); });
}

}  // namespace beaconless::cli
