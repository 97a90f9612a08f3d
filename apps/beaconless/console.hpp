// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::cli {

/// How the program ends.
enum ExitCode : int {
  exit_good = 0,
  exit_usage = 2,  ///< the words of the call
  exit_data = 3,   ///< a file that cannot be read, written or used
  exit_lost = 4,   ///< the robot was lost at the end of the recording
};

/// JSON as the program writes it. File names may hold any bytes; what is not UTF-8 becomes U+FFFD.
std::string json_text(const nlohmann::json& object);

/// Where the program's words go: results to standard output, everything about the work to standard error.
///
/// `quiet` leaves only results and errors; `json` makes the result one JSON object and nothing else.
class Console {
 public:
  bool quiet = false;
  bool json = false;

  /// A line of the result, for people; nothing in JSON mode.
  void say(const std::string& line) const;

  /// The result, for programs; nothing outside JSON mode.
  void result(const nlohmann::json& object) const;

  /// A line about the work.
  void note(const std::string& line) const;

  /// Something that the user should know, whatever the mode.
  void warn(const std::string& line) const;

  /// Says what went wrong and gives the exit code for it.
  int fail(const Error& error, int exit_code = exit_data) const;
};

/// A line that is drawn again and again while the work goes on: share done, rate and time left. Only on a
/// terminal.
class Progress {
 public:
  /// `total` 0: not known.
  Progress(const Console& console, std::string what, std::uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

 private:
  void draw() const;

  std::string what_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
};

/// Gathers a reader's problems: the first few in full, all of them counted.
///
/// A reader tells its problems on every pass; `listening` is turned on for the one that counts, and `forget`
/// makes way for the next.
class ProblemLog {
 public:
  bool listening = true;

  void add(const io::Problem& problem);
  void forget();
  void report(const Console& console) const;

  std::uint64_t count() const { return count_; }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::uint64_t count_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace beaconless::cli
