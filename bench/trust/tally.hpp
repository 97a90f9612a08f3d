// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "bench/trust/reliability.hpp"
#include "bench/trust/scan_record.hpp"

namespace beaconless::trust {

/// What the records of a trial count up to.
struct TrustTally {
  static constexpr std::size_t kStatuses = 6;

  double duration_s = 0.0;
  std::size_t scans = 0;
  std::array<std::size_t, kStatuses> by_status{};
  std::size_t ok_wrong = 0;          ///< ok, and not right
  std::size_t sure = 0;              ///< ok with a quality that says so
  std::size_t sure_wrong = 0;        ///< of those: not right. The false ok
  std::size_t sure_wrong_alike = 0;  ///< of those: no look at the scan alone could have told
  std::optional<std::size_t> first_sure_wrong;
  double worst_sure_wrong_m = 0.0;
  double worst_sure_wrong_rad = 0.0;
  std::size_t times_lost = 0;  ///< from any other status
  std::size_t jumps_told = 0;
  std::size_t jumps_untold = 0;  ///< steps between two ok poses that the robot did not make
  std::size_t bounded = 0;       ///< scans with a protection level
  std::size_t beyond = 0;        ///< of those: the error was larger
  ReliabilityBins reliability;   ///< of all scans but those before any start
  LevelBins levels;              ///< of scans that are ok
};

/// What may be asked of a trial's records.
struct TallyTerms {
  bool is_followed = true;   ///< else scans have nothing to do with those before them
  double reference_m = 0.0;  ///< how far the truth itself may be off
  double reference_rad = 0.0;
};

TrustTally tally(std::span<const ScanRecord> records, const TallyTerms& terms = {});

}  // namespace beaconless::trust
