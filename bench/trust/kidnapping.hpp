// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/trust/recorded_trials.hpp"
#include "bench/trust/scan_record.hpp"
#include "bench/trust/trial.hpp"

namespace beaconless::trust {

/// A robot that is followed, then carried to another place of the same map.
struct Kidnapping {
  Trial trial;
  std::size_t carried_at = 0;  ///< the first scan at the other place
  double carry_m = 0.0;
  double carry_rad = 0.0;
};

/// Makes them; recordings are read once.
class Kidnapper {
 public:
  /// Odd seeds carry through a recording, where there are any, even ones through a made-up building. Half
  /// of both carry no further than two metres, where such places are met.
  Kidnapping kidnapping(std::uint64_t seed);

 private:
  const Trial& recorded(std::size_t choice);

  std::vector<RecordedTrial> recordings_ = recorded_trials();
  std::map<std::string, Trial> read_;
};

/// What became of one.
struct CarryVerdict {
  bool was_ok = false;                ///< ok and right just before; else nothing follows from the rest
  std::optional<double> noticed_s;    ///< after the carry: lost, relocalizing, or told as a jump
  std::optional<double> degraded_s;   ///< the same for degraded
  std::optional<double> recovered_s;  ///< ok, within 0.3 m and 3 deg
  std::size_t wrong_ok = 0;           ///< scans after the carry
  std::size_t sure_wrong = 0;
  double last_wrong_ok_s = 0.0;
  std::optional<bool> is_unambiguous;  ///< whether the first scan alone finds the place; nothing: not told
};

CarryVerdict judge(const Kidnapping& kidnapping, std::span<const ScanRecord> records);

/// Whether a localizer that may be anywhere finds the place by the first scan after the carry.
std::optional<bool> is_unambiguous(const Kidnapping& kidnapping, const std::string& method);

}  // namespace beaconless::trust
