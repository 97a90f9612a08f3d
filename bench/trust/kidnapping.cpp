// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/kidnapping.hpp"

#include <algorithm>

#include "beaconless/core/rng.hpp"

#include "bench/trust/follow.hpp"
#include "bench/trust/simulated_trial.hpp"
#include "bench/trust/splice.hpp"

namespace beaconless::trust {
namespace {

constexpr double kBefore_s = 3.0;  // of scans, at least, on either side of the carry
constexpr double kAfter_s = 5.0;
constexpr std::size_t kLeastScans = 8;
constexpr double kLeastCarry_m = 0.5;
constexpr double kLeastCarry_rad = radians(10.0);
constexpr double kShortCarry_m = 2.0;
constexpr std::uint64_t kNextBuilding = 1'000'000'000;  // where a robot stands in the first one
constexpr double kFound_m = 0.3;
constexpr double kFound_rad = radians(3.0);

std::vector<double> scan_times_s(const Trial& trial) {
  std::vector<double> times;
  for (const Event& event : trial.events)
    if (const auto* scan = std::get_if<Scan>(&event)) times.push_back(scan->stamp().seconds());
  return times;
}

/// The scan before which a part that begins here may end; past the end where the trial is too short.
std::size_t end_of_part(const std::vector<double>& times_s, std::size_t first, double duration_s) {
  std::size_t end = first + kLeastScans;
  while (end <= times_s.size() && times_s[end - 1] - times_s[first] < duration_s) ++end;
  return end;
}

bool is_carry(double metres, double rad, bool is_short) {
  const bool is_enough = metres >= kLeastCarry_m || rad >= kLeastCarry_rad;
  return is_enough && (!is_short || metres <= kShortCarry_m);
}

/// Two places of one or two trials on the same map, and the run that they make; nothing where the robot
/// hardly drives.
std::optional<Kidnapping> carry(const Trial& from, const Trial& to, bool is_short, Rng& rng) {
  constexpr int kTries = 3000;
  const std::vector<double> from_s = scan_times_s(from);
  const std::vector<double> to_s = scan_times_s(to);
  for (int i = 0; i < kTries; ++i) {
    const auto first = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(from_s.size())));
    const auto next = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(to_s.size())));
    const std::size_t end = end_of_part(from_s, first, kBefore_s);
    const std::size_t next_end = end_of_part(to_s, next, kAfter_s);
    if (end > from_s.size() || next_end > to_s.size()) continue;
    const Pose2& last = from.truth[end - 1];
    Kidnapping made{.carried_at = end - first,
                    .carry_m = distance_m(last, to.truth[next]),
                    .carry_rad = heading_difference_rad(last, to.truth[next])};
    if (!is_carry(made.carry_m, made.carry_rad, is_short && i < kTries / 2)) continue;
    made.trial = splice({&from, first, end}, {&to, next, next_end});
    return made;
  }
  return std::nullopt;
}

double after_s(const Kidnapping& kidnapping, std::span<const ScanRecord> records, std::size_t i) {
  return seconds_between(records[kidnapping.carried_at].estimate.stamp, records[i].estimate.stamp);
}

bool is_found(const Pose2& pose, const Pose2& truth, const Trial& trial) {
  return distance_m(pose, truth) <= kFound_m + trial.reference_m &&
         heading_difference_rad(pose, truth) <= kFound_rad + trial.reference_rad;
}

bool is_notice(const PoseEstimate& estimate) {
  return estimate.status == Status::lost || estimate.status == Status::relocalizing || estimate.jumped;
}

}  // namespace

const Trial& Kidnapper::recorded(std::size_t choice) {
  std::vector<const RecordedTrial*> usable;
  for (const RecordedTrial& recording : recordings_)
    if (recording.can_be_carried) usable.push_back(&recording);
  const RecordedTrial& chosen = *usable[choice % usable.size()];
  if (!read_.contains(chosen.name)) read_.emplace(chosen.name, chosen.read());
  return read_.at(chosen.name);
}

Kidnapping Kidnapper::kidnapping(std::uint64_t seed) {
  Rng rng(seed);
  const bool is_short = rng.uniform() < 0.5;
  const bool has_recordings = std::any_of(recordings_.begin(), recordings_.end(),
                                          [](const RecordedTrial& r) { return r.can_be_carried; });
  std::optional<Kidnapping> made;
  if (seed % 2 == 1 && has_recordings) {
    const Trial& trial = recorded(seed / 2);
    made = carry(trial, trial, is_short, rng);
  }
  for (std::uint64_t building = seed; !made; building += kNextBuilding) {
    const std::array<Trial, 2> parts = simulated_parts(building);
    made = carry(parts[0], parts[seed / 8 % 2], is_short, rng);
  }
  made->trial.seed = seed;
  return *made;
}

CarryVerdict judge(const Kidnapping& kidnapping, std::span<const ScanRecord> records) {
  CarryVerdict verdict;
  const ScanRecord& before = records[kidnapping.carried_at - 1];
  verdict.was_ok = before.estimate.ok() && before.is_right;
  for (std::size_t i = kidnapping.carried_at; i < records.size(); ++i) {
    const PoseEstimate& estimate = records[i].estimate;
    const double time_s = after_s(kidnapping, records, i);
    if (!verdict.noticed_s && is_notice(estimate)) verdict.noticed_s = time_s;
    if (!verdict.degraded_s && estimate.status == Status::degraded) verdict.degraded_s = time_s;
    const bool is_there = is_found(estimate.map_from_base, records[i].truth, kidnapping.trial);
    if (!verdict.recovered_s && estimate.ok() && is_there) verdict.recovered_s = time_s;
    if (!estimate.ok() || records[i].is_right) continue;
    ++verdict.wrong_ok;
    verdict.sure_wrong += records[i].is_sure() ? 1 : 0;
    verdict.last_wrong_ok_s = time_s;
  }
  return verdict;
}

std::optional<bool> is_unambiguous(const Kidnapping& kidnapping, const std::string& method) {
  const auto localizer = localizer_for(kidnapping.trial, method);
  localizer->start_anywhere();
  const PoseEstimate estimate = localizer->update(scan_of(kidnapping.trial, kidnapping.carried_at));
  if (estimate.status == Status::not_started) return std::nullopt;
  const Pose2& truth = kidnapping.trial.truth[kidnapping.carried_at];
  const auto candidates = localizer->candidates();
  if (candidates.size() == 1) return is_found(candidates.front().map_from_base, truth, kidnapping.trial);
  const bool is_taken = estimate.ok() || estimate.status == Status::degraded;
  return candidates.empty() && is_taken && is_found(estimate.map_from_base, truth, kidnapping.trial);
}

}  // namespace beaconless::trust
