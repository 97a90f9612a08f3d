// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/tell.hpp"

#include <iomanip>
#include <ostream>

#include <nlohmann/json.hpp>

namespace beaconless::trust {
namespace {

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json statuses(const TrustTally& tally) {
  nlohmann::json told;
  for (std::size_t i = 0; i < tally.by_status.size(); ++i)
    told[std::string(to_string(static_cast<Status>(i)))] = tally.by_status[i];
  return told;
}

std::string_view begin_of(const Trial& trial) {
  if (!trial.starts.front().map_from_base) return "anywhere";
  return *trial.starts.front().map_from_base == trial.truth.front() ? "truth" : "beside";
}

}  // namespace

void tell(std::ostream& out, std::size_t number, const Trial& trial, const TrustTally& tally) {
  out << nlohmann::json{{"case", number},
                        {"kind", trial.kind},
                        {"family", trial.family},
                        {"seed", trial.seed},
                        {"start", begin_of(trial)},
                        {"map", std::holds_alternative<FloorPlan>(*trial.map) ? "walls" : "grid"},
                        {"duration_s", tally.duration_s},
                        {"scans", tally.scans},
                        {"statuses", statuses(tally)},
                        {"ok_wrong", tally.ok_wrong},
                        {"sure", tally.sure},
                        {"sure_wrong", tally.sure_wrong},
                        {"sure_wrong_alike", tally.sure_wrong_alike},
                        {"first_sure_wrong", or_null(tally.first_sure_wrong)},
                        {"worst_sure_wrong_m", tally.worst_sure_wrong_m},
                        {"worst_sure_wrong_deg", degrees(tally.worst_sure_wrong_rad)},
                        {"times_lost", tally.times_lost},
                        {"jumps_told", tally.jumps_told},
                        {"jumps_untold", tally.jumps_untold},
                        {"bounded", tally.bounded},
                        {"beyond", tally.beyond},
                        {"bins", tally.reliability.count},
                        {"bins_right", tally.reliability.right},
                        {"levels", tally.levels.count}}
             .dump()
      << std::endl;
}

void tell(std::ostream& out, std::size_t number, const Kidnapping& kidnapping, const CarryVerdict& verdict) {
  out << nlohmann::json{{"case", number},
                        {"kind", "kidnapping"},
                        {"family", kidnapping.trial.family},
                        {"is_recorded", kidnapping.trial.kind == "recording"},
                        {"seed", kidnapping.trial.seed},
                        {"carry_m", kidnapping.carry_m},
                        {"carry_deg", degrees(kidnapping.carry_rad)},
                        {"was_ok", verdict.was_ok},
                        {"noticed_s", or_null(verdict.noticed_s)},
                        {"degraded_s", or_null(verdict.degraded_s)},
                        {"recovered_s", or_null(verdict.recovered_s)},
                        {"wrong_ok", verdict.wrong_ok},
                        {"sure_wrong", verdict.sure_wrong},
                        {"last_wrong_ok_s", verdict.last_wrong_ok_s},
                        {"is_unambiguous", or_null(verdict.is_unambiguous)}}
             .dump()
      << std::endl;
}

void trace(std::ostream& out, std::span<const ScanRecord> records) {
  out << "scan    time_s  status        quality  error_m  error_deg  level_m  explained at_truth  x y deg\n"
      << std::fixed;
  std::size_t i = 0;
  for (const ScanRecord& record : records) {
    const PoseEstimate& estimate = record.estimate;
    out << std::setw(4) << i++ << std::setprecision(3) << std::setw(10) << estimate.stamp.seconds() << "  "
        << std::left << std::setw(13) << to_string(estimate.status) << std::right << std::setprecision(2)
        << std::setw(8) << estimate.quality << std::setprecision(3) << std::setw(9) << record.error_m()
        << std::setprecision(2) << std::setw(11) << degrees(record.error_rad()) << std::setw(9)
        << estimate.protection_m << std::setw(11) << record.explained.value_or(-1.0) << std::setw(9)
        << record.explained_at_truth.value_or(-1.0) << "  " << estimate.map_from_base
        << (estimate.jumped ? " jumped" : "") << (record.is_sure() && !record.is_right ? " WRONG" : "")
        << (estimate.reason.empty() ? "" : "  ") << estimate.reason << "\n";
  }
}

}  // namespace beaconless::trust
