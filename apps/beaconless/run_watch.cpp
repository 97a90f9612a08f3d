// SPDX-License-Identifier: Apache-2.0
#include "run_watch.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "beaconless/io/config_yaml.hpp"

namespace beaconless::cli {
namespace {

/// A word as a shell takes it for one.
std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                              "_-./,:=+@%") == std::string::npos)
    return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? "'\\''" : std::string(1, letter);
  return text + "'";
}

io::BlackBoxAbout about(const LocalizeWords& words, const LocalizePlan& plan, const io::MapIdentity& map,
                        const std::string& start) {
  LocalizerConfig config = plan.config;
  LocalizerConfig defaults;
  const std::string map_path = std::filesystem::absolute(words.map).lexically_normal().string();
  return {.start = start,
          .lines = {{"method", plan.config.method},
                    {"recording", words.recording},
                    {"map", map_path},
                    {"map_hash", io::hash_text(map.hash)}},
          .command_options = " --map " + quoted(map_path),
          .config_yaml = io::config_yaml(fields_of(config), fields_of(defaults))};
}

}  // namespace

RunWatch::RunWatch(const Console& console, const LocalizeWords& words, const LocalizePlan& plan,
                   const io::MapIdentity& map, const std::string& start)
    : console_(console) {
  if (!words.save_pose.empty()) saver_.emplace(words.save_pose, map);
  if (!words.black_box.empty()) box_.emplace(words.black_box, about(words, plan, map, start));
}

void RunWatch::update(const Event& event, const PoseEstimate& estimate) {
  if (saver_) told(saver_->update(estimate));
  if (box_) told(box_->update(event, estimate));
}

void RunWatch::finish() {
  if (saver_) told(saver_->finish());
  if (box_) told(box_->finish());
}

void RunWatch::told(const Result<Done>& saved) {
  if (saved || std::exchange(is_save_told_, true)) return;
  console_.warn("the last pose is not saved: " + to_string(saved.error()));
}

void RunWatch::told(const Result<std::optional<io::WrittenBox>>& box) {
  if (!box) {
    if (!std::exchange(is_box_told_, true))
      console_.warn("a black box is not written: " + to_string(box.error()));
  } else if (*box) {
    console_.note(fmt::format("black box: {} ({})", (*box)->folder, (*box)->reason));
  } else if (box_->is_full() && !std::exchange(is_full_told_, true)) {
    console_.warn("no more black boxes are written in this run");
  }
}

}  // namespace beaconless::cli
