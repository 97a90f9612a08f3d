// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/tally.hpp"

#include <cmath>

namespace beaconless::trust {
namespace {

void count_wrong(TrustTally& tally, const ScanRecord& record, std::size_t scan) {
  tally.ok_wrong += record.estimate.ok() && !record.is_right ? 1 : 0;
  tally.sure += record.is_sure() ? 1 : 0;
  if (!record.is_sure() || record.is_right) return;
  ++tally.sure_wrong;
  tally.sure_wrong_alike += record.looks_right() ? 1 : 0;
  if (!tally.first_sure_wrong) tally.first_sure_wrong = scan;
  tally.worst_sure_wrong_m = std::max(tally.worst_sure_wrong_m, record.error_m());
  tally.worst_sure_wrong_rad = std::max(tally.worst_sure_wrong_rad, record.error_rad());
}

/// Whether two poses in a row that are both ok are further apart than the robot drove.
bool is_untold_jump(const ScanRecord& before, const ScanRecord& now, const TallyTerms& terms) {
  if (!before.estimate.ok() || !now.estimate.ok() || now.estimate.jumped) return false;
  const Pose2 step = before.estimate.map_from_base.inverse() * now.estimate.map_from_base;
  const Pose2 true_step = before.truth.inverse() * now.truth;
  return distance_m(step, true_step) > kWrong_m + 2.0 * terms.reference_m ||
         heading_difference_rad(step, true_step) > kWrong_rad + 2.0 * terms.reference_rad;
}

void count_level(TrustTally& tally, const ScanRecord& record, const TallyTerms& terms) {
  const PoseEstimate& estimate = record.estimate;
  if (estimate.ok()) tally.levels.add(estimate.protection_m);
  if (estimate.protection_m >= PoseEstimate::kUnbounded_m) return;
  ++tally.bounded;
  const bool is_within = record.error_m() <= estimate.protection_m + terms.reference_m &&
                         record.error_rad() <= estimate.protection_rad + terms.reference_rad;
  tally.beyond += is_within ? 0 : 1;
}

}  // namespace

void LevelBins::add(double level_m) {
  constexpr double kLeast_m = 1e-3;
  const double bin = 10.0 * std::log10(std::max(level_m, kLeast_m) / kLeast_m);
  ++count[std::min(static_cast<std::size_t>(bin), kBins - 1)];
}

TrustTally tally(std::span<const ScanRecord> records, const TallyTerms& terms) {
  TrustTally tally;
  tally.scans = records.size();
  if (!records.empty() && terms.is_followed)
    tally.duration_s = seconds_between(records.front().estimate.stamp, records.back().estimate.stamp);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const ScanRecord& record = records[i];
    const Status status = record.estimate.status;
    ++tally.by_status[static_cast<std::size_t>(status)];
    count_wrong(tally, record, i);
    if (status == Status::not_started) continue;
    count_level(tally, record, terms);
    tally.reliability.add(record.estimate.quality, record.is_right);
    tally.jumps_told += record.estimate.jumped ? 1 : 0;
    if (i == 0 || !terms.is_followed) continue;
    const bool was_lost = records[i - 1].estimate.status == Status::lost;
    tally.times_lost += status == Status::lost && !was_lost ? 1 : 0;
    tally.jumps_untold += is_untold_jump(records[i - 1], record, terms) ? 1 : 0;
  }
  return tally;
}

}  // namespace beaconless::trust
