// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/recording_writer.hpp"

#include "commands.hpp"
#include "laser_set.hpp"
#include "words.hpp"

namespace beaconless::cli {
namespace {

struct ConvertWords {
  std::string from;
  std::string to;
  std::vector<std::string> topics;
  ScanWords scan;
  std::string compression;
};

/// What is copied, which scans of it, and how.
struct Source {
  io::Recording recording;
  io::ScanSelection scans;
  io::RecordingWriterOptions options;
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

Result<Source> open_one(const ConvertWords& words, const io::ScanSelection& scans, ProblemLog& problems) {
  ScanWords of_one = words.scan;
  if (!words.topics.empty()) of_one.topic = words.topics.front();
  auto from = open_recording(words.from, of_one, problems);
  if (!from) return from.error();
  io::RecordingWriterOptions options{
      .scan_topic = from->scan_topic(), .compression = words.compression, .laser_place = from->laser_place()};
  return Source{*std::move(from), scans, std::move(options)};
}

Result<Source> open_several(const ConvertWords& words, const io::ScanSelection& scans, ProblemLog& problems) {
  auto lasers = open_each(words.from, words.scan, words.topics, problems);
  if (!lasers) return lasers.error();
  io::RecordingWriterOptions options{.compression = words.compression};
  for (const io::LaserRecording& laser : *lasers)
    options.lasers[laser.frame_id] = {laser.recording.scan_topic(), laser.recording.laser_place()};
  const auto add = [&problems](const io::Problem& problem) { problems.add(problem); };
  return Source{io::merge_recordings(*std::move(lasers), scans, add), {}, std::move(options)};
}

/// Tells what the copy has no room for, and takes it off what was copied.
nlohmann::json settle_left_out(const Console& console, const io::RecordingWriter& to, Copied& copied) {
  nlohmann::json told = nlohmann::json::object();
  for (const auto& [source, count] : to.left_out()) {
    copied.odometry -= count.odometry;
    copied.poses -= count.poses;
    told[source] = count.odometry + count.poses;
    console.warn(
        fmt::format("{} readings of {} are left out: a CARMEN log has room for one source of poses and "
                    "one of odometry",
                    count.odometry + count.poses, source));
  }
  return told;
}

int convert(const Console& console, const ConvertWords& words) {
  const auto scans = words.scan.selection();
  if (!scans) return console.fail(scans.error(), exit_usage);
  io::RecordingWriterOptions options{.compression = words.compression};
  if (words.topics.size() > 1)
    for (const std::string& topic : words.topics) options.lasers[topic] = {};  // their frames come later
  if (const auto possible = io::can_write_recording(words.to, options); !possible)
    return console.fail(possible.error(), exit_usage);
  ProblemLog problems;
  problems.listening = false;
  const auto from =
      words.topics.size() > 1 ? open_several(words, *scans, problems) : open_one(words, *scans, problems);
  if (!from) return console.fail(from.error());
  std::error_code ignored;
  if (std::filesystem::equivalent(words.from, words.to, ignored))
    return console.fail({words.to, "is the recording itself", "give the copy another name"}, exit_usage);
  auto to = io::make_recording_writer(words.to, from->options);
  if (!to) return console.fail(to.error());

  problems.listening = true;
  Copied copied = copy(from->recording, from->scans, *to.value());
  problems.report(console);
  const auto left_out = settle_left_out(console, *to.value(), copied);
  if (auto written = to.value()->finish(); !written) return console.fail(written.error());
  const std::uint64_t bytes = bytes_of(words.to);
  console.say(fmt::format("{}: {} scans, {} odometry readings, {} poses, {:.1f} MB", words.to, copied.scans,
                          copied.odometry, copied.poses, static_cast<double>(bytes) * 1e-6));
  console.result({{"out", words.to},
                  {"scans", copied.scans},
                  {"odometry", copied.odometry},
                  {"poses", copied.poses},
                  {"skipped", copied.skipped},
                  {"left_out", left_out},
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
  command
      ->add_option("--topic", words->topics,
                   "Which scans: a topic of a bag, a keyword of a log; of several lasers one topic each")
      ->allow_extra_args(false);
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  command->add_option("--compression", words->compression,
                      "How its chunks are packed: MCAP zstd (default), lz4, none; ROS 1 bag lz4 (default), "
                      "bz2, none");
  command->footer("Example:  beaconless convert drive.bag drive.mcap --topic /scan");
  command->callback([&console, &exit_code, words] { exit_code = convert(console, *words); });
}

}  // namespace beaconless::cli
