// SPDX-License-Identifier: Apache-2.0
#include "scan_options.hpp"

namespace beaconless::cli {

void add_scan_range_options(CLI::App& verb, ScanWords& words) {
  verb.add_option("--min-range", words.min_range_m, "Take nearer beams for no hits [m]")
      ->check(not_from_zero_on, "NUMBER >= 0");
  verb.add_option("--max-range", words.max_range_m, "Take beams this far or further for no return [m]")
      ->check(not_from_zero_on, "NUMBER >= 0");
}

void add_scan_time_options(CLI::App& verb, ScanWords& words) {
  verb.add_option("--stamp-is", words.stamp_is, "The beam that the scans' stamps mean")
      ->check(CLI::IsMember({"first", "middle", "last"}))
      ->capture_default_str();
  verb.add_option("--sweep-time", words.sweep_time_s,
                  "From a sweep's first beam to its last [s], where the source does not tell or tells wrong")
      ->check(not_a_sweep, "0 <= NUMBER < 60");
}

}  // namespace beaconless::cli
