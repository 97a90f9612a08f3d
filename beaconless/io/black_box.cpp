// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/black_box.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/whole_file.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 1000;

bool is_scan(const Event& event) { return std::holds_alternative<Scan>(event); }

/// A folder that is not there yet.
Result<std::string> free_name(const std::string& wanted) {
  std::error_code ignored;
  for (int i = 1; i < kMostNames; ++i) {
    const std::string name = i == 1 ? wanted : fmt::format("{}_{}", wanted, i);
    if (!fs::exists(name, ignored)) return name;
  }
  return Error{wanted, "there are boxes of this name already", "empty the folder of --blackbox"};
}

}  // namespace

BlackBox::BlackBox(std::string folder, BlackBoxAbout about, const BlackBoxConfig& config)
    : folder_(std::move(folder)), about_(std::move(about)), config_(config) {}

Result<std::optional<WrittenBox>> BlackBox::update(const Event& event, const PoseEstimate& estimate) {
  if (std::holds_alternative<ReferencePose>(event)) return std::optional<WrittenBox>{};
  // 1. Keep it.
  keep(event, estimate);
  if (!is_scan(event)) return std::optional<WrittenBox>{};
  // 2. A box that waits gets the scan too, and is written once it has enough.
  if (!reason_.empty()) {
    if (--scans_to_wait_ > 0) return std::optional<WrittenBox>{};
    return write();
  }
  // 3. Is there a reason for one?
  const std::string_view reason = reason_now(estimate);
  if (reason.empty()) return std::optional<WrittenBox>{};
  is_armed_ = false;
  was_good_ = false;
  is_full_ = boxes_ >= config_.most_boxes;
  if (is_full_) return std::optional<WrittenBox>{};
  reason_ = reason;
  detail_ = fmt::format("{}, quality {:.2f}{}{}", to_string(estimate.status), estimate.quality,
                        estimate.reason.empty() ? "" : ": ", estimate.reason);
  when_ = estimate.stamp;
  scans_to_wait_ = config_.scans_after;
  if (scans_to_wait_ == 0) return write();
  return std::optional<WrittenBox>{};
}

Result<std::optional<WrittenBox>> BlackBox::finish() {
  if (reason_.empty()) return std::optional<WrittenBox>{};
  return write();
}

void BlackBox::keep(const Event& event, const PoseEstimate& estimate) {
  kept_.push_back({event, estimate});
  if (is_scan(event)) ++kept_scans_;
  const Stamp now = stamp_of(event);
  while (kept_.size() > 1) {
    const Kept& oldest = kept_.front();
    const bool is_old = seconds_between(stamp_of(oldest.event), now) > config_.keep_s;
    if (!is_old && kept_scans_ <= config_.most_scans && kept_.size() <= config_.most_events) break;
    if (is_scan(oldest.event)) {
      --kept_scans_;
      has_forgotten_ = true;
    }
    kept_.pop_front();
  }
}

std::string_view BlackBox::reason_now(const PoseEstimate& estimate) {
  const bool is_low = estimate.quality < config_.low_quality;
  low_scans_ = is_low ? low_scans_ + 1 : 0;
  is_armed_ = is_armed_ || estimate.ok();
  was_good_ = was_good_ || (estimate.ok() && !is_low);
  if (!is_armed_) return "";
  if (estimate.status == Status::lost || estimate.status == Status::relocalizing)
    return to_string(estimate.status);
  return was_good_ && low_scans_ >= config_.low_quality_scans ? "low_quality" : "";
}

Result<std::optional<WrittenBox>> BlackBox::write() {
  const std::string reason(std::exchange(reason_, ""));
  const auto name = free_name((fs::path(folder_) / fmt::format("{}_{}", to_string(when_), reason)).string());
  if (!name) return name.error();
  // Half a box shall not look like one: it gets its name when it is whole.
  const std::string part = *name + ".part";
  std::error_code failed;
  fs::create_directories(part, failed);
  if (failed) return Error{part, failed.message(), "choose another folder for --blackbox"};
  if (auto written = write_files(part); !written) {
    fs::remove_all(part, failed);
    return written.error();
  }
  fs::rename(part, *name, failed);
  if (failed) return Error{*name, failed.message(), "choose another folder for --blackbox"};
  ++boxes_;
  return std::optional<WrittenBox>{WrittenBox{*name, detail_}};
}

Result<Done> BlackBox::write_files(const std::string& folder) const {
  const fs::path path(folder);
  CarmenWriter log((path / "recording.log").string(), "kept by the black box of beaconless; see why.yaml");
  EstimatesCsvWriter estimates((path / "estimates.csv").string());
  for (const Kept& kept : kept_) {
    if (const auto* odometry = std::get_if<Odometry>(&kept.event)) log.write(*odometry);
    const auto* scan = std::get_if<Scan>(&kept.event);
    if (scan == nullptr) continue;
    log.write(*scan);
    estimates.write(kept.estimate);
  }
  if (!log.close()) return Error{folder, "the scans cannot be written", "is there room on the disk?"};
  if (auto written = estimates.finish(); !written) return written;
  if (auto written = write_whole_file((path / "config.yaml").string(), about_.config_yaml); !written)
    return written;
  return write_whole_file((path / "why.yaml").string(), why_text());
}

/// Where a replay of what is kept has to start.
std::string BlackBox::start_words() const {
  if (!has_forgotten_) return about_.start;
  for (const Kept& kept : kept_) {
    if (!is_scan(kept.event)) continue;
    if (!kept.estimate.ok()) return "auto";
    const Pose2& pose = kept.estimate.map_from_base;
    return fmt::format("{},{},{}", pose.x_m, pose.y_m, degrees(pose.theta_rad));
  }
  return "auto";
}

std::string BlackBox::why_text() const {
  std::string text =
      fmt::format("when: {}\nreason: {}\nfirst: {}\nlast: {}\nscans: {}\nstart: {}\n", to_string(when_),
                  yaml_text(detail_), to_string(stamp_of(kept_.front().event)),
                  to_string(stamp_of(kept_.back().event)), kept_scans_, yaml_text(start_words()));
  for (const auto& [key, value] : about_.lines) text += fmt::format("{}: {}\n", key, yaml_text(value));
  return text + "replay: " +
         yaml_text(fmt::format("beaconless localize recording.log{} --config config.yaml --start={}",
                               about_.command_options, start_words())) +
         "\n";
}

}  // namespace beaconless::io
