// SPDX-License-Identifier: Apache-2.0
#include "run_summary.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "beaconless/eval/trust.hpp"

namespace beaconless::cli {
namespace {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

template <class Value>
std::vector<double> values_of(const Run& run, Value value) {
  std::vector<double> values;
  for (const PoseEstimate& estimate : run.replay.estimates) values.push_back(value(estimate));
  return values;
}

nlohmann::json quality_of(const Run& run) {
  const auto values = values_of(run, [](const PoseEstimate& e) { return e.quality; });
  return {{"min", percentile(values, 0.0)},
          {"p5", percentile(values, 0.05)},
          {"median", percentile(values, 0.5)},
          {"p95", percentile(values, 0.95)}};
}

nlohmann::json protection_of(const std::vector<double>& values) {
  return {{"median", percentile(values, 0.5)},
          {"p95", percentile(values, 0.95)},
          {"max", percentile(values, 1.0)}};
}

nlohmann::json to_json(const report::CandidatePlaces& fitted) {
  nlohmann::json places = nlohmann::json::array();
  for (const report::CandidatePlace& place : fitted.places)
    places.push_back({{"x_m", place.map_from_base.x_m},
                      {"y_m", place.map_from_base.y_m},
                      {"theta_rad", place.map_from_base.theta_rad},
                      {"score", place.score},
                      {"weight", place.weight}});
  return {{"scan", fitted.scan_index}, {"stamp", to_string(fitted.stamp)}, {"places", places}};
}

nlohmann::json to_json(const eval::Trust& trust) {
  nlohmann::json bins = nlohmann::json::array();
  for (const eval::QualityBin& bin : trust.bins)
    bins.push_back({{"from", bin.low}, {"to", bin.high}, {"count", bin.count}, {"near", bin.near_count}});
  return {{"trusted", trust.trusted_count},
          {"false_ok", trust.false_ok_count},
          {"false_ok_ratio", trust.false_ok_ratio()},
          {"bounded", trust.bounded_count},
          {"protection_violations", trust.violation_count},
          {"reliability", bins}};
}

std::string place_words(const report::CandidatePlace& place) {
  const Pose2& at = place.map_from_base;
  return fmt::format("{:.2f},{:.2f},{:.1f}", at.x_m, at.y_m, degrees(at.theta_rad));
}

}  // namespace

std::map<std::string, std::size_t> status_counts(const Run& run) {
  std::map<std::string, std::size_t> counts;
  for (const PoseEstimate& estimate : run.replay.estimates) ++counts[std::string(to_string(estimate.status))];
  return counts;
}

std::map<std::string, std::size_t> reason_counts(const Run& run) {
  std::map<std::string, std::size_t> counts;
  for (const PoseEstimate& estimate : run.replay.estimates)
    if (!estimate.ok()) ++counts[fmt::format("{}: {}", to_string(estimate.status), estimate.reason)];
  return counts;
}

std::vector<std::string> jumps_of(const Run& run) {
  const auto& estimates = run.replay.estimates;
  std::vector<std::string> jumps;
  for (std::size_t i = 1; i < estimates.size(); ++i)
    if (estimates[i].jumped)
      jumps.push_back(fmt::format("jumped {:.2f} m at {:.2f} s",
                                  distance_m(estimates[i - 1].map_from_base, estimates[i].map_from_base),
                                  seconds_between(estimates.front().stamp, estimates[i].stamp)));
  return jumps;
}

std::vector<std::string> ambiguous_lines(const Run& run) {
  const auto& replay = run.replay;
  if (run.windows || replay.estimates.back().status != Status::relocalizing || replay.places.empty() ||
      replay.places.back().scan_index != replay.scan_indices.back())
    return {};
  const report::CandidatePlaces& fitted = replay.places.back();
  std::vector<std::string> lines{
      fmt::format("ambiguous: {} {}", fitted.place_count,
                  fitted.place_count == 1 ? "place fits, but not for sure" : "places fit")};
  for (std::size_t i = 0; i < fitted.places.size(); ++i)
    lines.push_back(fmt::format("  {}. {}  weight {:.2f}, score {:.2f}", i + 1, place_words(fitted.places[i]),
                                fitted.places[i].weight, fitted.places[i].score));
  return lines;
}

nlohmann::json summary_of(const LocalizeWords& words, const Run& run,
                          const std::optional<Judgement>& judgement) {
  const auto& times = run.replay.update_us;
  nlohmann::json summary = {
      {"method", run.config.method},
      {"recording", words.recording},
      {"map", words.map},
      {"scans", run.replay.estimates.size()},
      {"status_counts", status_counts(run)},
      {"reason_counts", reason_counts(run)},
      {"skipped_records", run.replay.skipped_records},
      {"update_us",
       {{"median", percentile(times, 0.5)},
        {"p99", percentile(times, 0.99)},
        {"max", percentile(times, 1.0)}}},
      {"quality", quality_of(run)},
      {"protection_m", protection_of(values_of(run, [](const PoseEstimate& e) { return e.protection_m; }))},
      {"protection_rad",
       protection_of(values_of(run, [](const PoseEstimate& e) { return e.protection_rad; }))},
      {"jumps", jumps_of(run).size()}};
  if (!run.replay.places.empty()) {
    summary["places"] = nlohmann::json::array();
    for (const report::CandidatePlaces& fitted : run.replay.places)
      summary["places"].push_back(to_json(fitted));
  }
  for (const LaserOnRobot& laser : run.config.lasers) {
    const Pose2& at = laser.base_from_laser;
    summary["lasers"].push_back(
        {{"frame_id", laser.frame_id}, {"base_from_laser", {at.x_m, at.y_m, at.theta_rad}}});
  }
  if (run.windows) summary["windows"] = run.windows->summary;
  if (judgement) summary["error"] = to_json(*judgement);
  if (run.reference)
    summary["trust"] = to_json(eval::trust_of(eval::judge_estimates(run.replay.estimates, *run.reference)));
  return summary;
}

}  // namespace beaconless::cli
