// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace beaconless::cli {
namespace {

constexpr std::size_t kShownProblems = 20;
constexpr auto kRedraw = std::chrono::milliseconds(100);

}  // namespace

std::string json_text(const nlohmann::json& object) {
  return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

void Console::say(const std::string& line) const {
  if (!json) fmt::print("{}\n", line);
}

void Console::result(const nlohmann::json& object) const {
  if (json) fmt::print("{}\n", json_text(object));
}

void Console::note(const std::string& line) const {
  if (!quiet && !json) fmt::print(stderr, "{}\n", line);
}

void Console::warn(const std::string& line) const { fmt::print(stderr, "warning: {}\n", line); }

int Console::fail(const Error& error, int exit_code) const {
  fmt::print(stderr, "error: {}\n", to_string(error));
  return exit_code;
}

Progress::Progress(const Console& console, std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(total),
      shown_(!console.quiet && !console.json && isatty(fileno(stderr)) != 0),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void Progress::step() {
  ++done_;
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - drawn_ < kRedraw) return;
  drawn_ = now;
  draw();
}

void Progress::draw() const {
  const double elapsed_s = std::chrono::duration<double>(drawn_ - start_).count();
  const double rate_hz = static_cast<double>(done_) / std::max(elapsed_s, 1e-3);
  std::string line = fmt::format("{} {}", what_, done_);
  if (total_ >= done_ && total_ > 0) line += fmt::format(" of {} ({} %)", total_, 100 * done_ / total_);
  line += fmt::format(", {:.0f} a second", rate_hz);
  if (total_ >= done_ && total_ > 0)
    line += fmt::format(", {:.0f} s left", static_cast<double>(total_ - done_) / rate_hz);
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
}

void ProblemLog::add(const io::Problem& problem) {
  if (!listening) return;
  std::string line = problem.where + ": " + problem.what;
  // Several lasers of one file are several passes over it, each of which tells of it.
  if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) return;
  ++count_;
  if (lines_.size() < kShownProblems) lines_.push_back(std::move(line));
}

void ProblemLog::forget() {
  count_ = 0;
  lines_.clear();
}

void ProblemLog::report(const Console& console) const {
  for (const std::string& line : lines_) console.warn(line);
  if (count_ > lines_.size()) console.warn(fmt::format("… and {} more like these", count_ - lines_.size()));
}

}  // namespace beaconless::cli
