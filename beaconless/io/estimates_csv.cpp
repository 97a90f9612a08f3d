// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/estimates_csv.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr std::array kStatuses{Status::not_started, Status::not_a_scan, Status::ok,
                               Status::degraded,    Status::lost,       Status::relocalizing};
constexpr std::size_t kColumns = 15;
constexpr std::size_t kOldColumns = 12;

std::optional<Status> status_of(std::string_view word) {
  for (const Status status : kStatuses)
    if (to_string(status) == word) return status;
  return std::nullopt;
}

/// The estimate of a row, or what is wrong with it.
struct Row {
  std::optional<PoseEstimate> estimate;
  std::string what;
};

Row estimate_of(std::string_view text, std::size_t columns) {
  const auto words = split_words(text, ",");
  if (words.size() != columns)
    return {
        {},
        "there are " + std::to_string(words.size()) + " values, an estimate has " + std::to_string(columns)};
  const auto stamp = parse_stamp(words[0]);
  if (!stamp) return {{}, "\"" + shown(words[0]) + "\" is not a time in seconds"};
  const auto status = status_of(words[10]);
  if (!status) return {{}, "\"" + shown(words[10]) + "\" is not a status"};
  std::array<double, kColumns> n{};
  for (std::size_t i = 1; i < columns; ++i) {
    if (i == 10) continue;
    const auto number = parse_double(words[i]);
    if (!number || !std::isfinite(*number)) return {{}, "\"" + shown(words[i]) + "\" is not a finite number"};
    n[i] = *number;
  }
  PoseEstimate estimate{.stamp = *stamp,
                        .map_from_base = {n[1], n[2], n[3]},
                        .status = *status,
                        .reason = "",
                        .quality = n[11]};
  estimate.covariance << n[4], n[5], n[6], n[5], n[7], n[8], n[6], n[8], n[9];
  if (columns == kOldColumns) return {estimate, {}};
  estimate.protection_m = n[12];
  estimate.protection_rad = n[13];
  estimate.jumped = n[14] != 0.0;
  return {estimate, {}};
}

}  // namespace

EstimatesCsvWriter::EstimatesCsvWriter(const std::string& path)
    : path_(path), out_(path, std::ios::binary | std::ios::trunc) {
  out_ << kEstimatesCsvHeader << '\n';
}

void EstimatesCsvWriter::write(const PoseEstimate& estimate) {
  const Pose2& pose = estimate.map_from_base;
  const Eigen::Matrix3d& c = estimate.covariance;
  out_ << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", to_string(estimate.stamp), pose.x_m,
                      pose.y_m, pose.theta_rad, c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2),
                      to_string(estimate.status), estimate.quality, estimate.protection_m,
                      estimate.protection_rad, estimate.jumped ? 1 : 0);
}

Result<Done> EstimatesCsvWriter::finish() {
  out_.close();
  if (!out_) return Error{path_, "cannot be written", "is there such a folder, and room in it?"};
  return Done{};
}

Result<std::vector<PoseEstimate>> read_estimates_csv(const std::string& path,
                                                     const std::function<void(const Problem&)>& on_problem) {
  const auto text = read_text_table(path);
  if (!text) return text.error();
  std::vector<PoseEstimate> estimates;
  bool first = true;
  std::size_t columns = 0;  // by the header; 0: it is another
  for_each_row(*text, [&](std::size_t line, std::string_view row) {
    if (first) {
      columns = row == kEstimatesCsvHeader ? kColumns : row == kOldEstimatesCsvHeader ? kOldColumns : 0;
    } else if (columns > 0) {
      Row read = estimate_of(row, columns);
      if (read.estimate) estimates.push_back(*read.estimate);
      if (!read.what.empty() && on_problem) on_problem({path + ":" + std::to_string(line), read.what});
    }
    first = false;
  });
  if (columns == 0)
    return Error{path, first ? "the file is empty" : "the first line is not that of a file of estimates",
                 "expected: " + std::string(kEstimatesCsvHeader)};
  return estimates;
}

}  // namespace beaconless::io
