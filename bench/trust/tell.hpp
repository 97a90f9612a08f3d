// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <span>

#include "bench/trust/kidnapping.hpp"
#include "bench/trust/tally.hpp"

namespace beaconless::trust {

/// One line of JSON: a trial and all that was counted.
void tell(std::ostream& out, std::size_t number, const Trial& trial, const TrustTally& tally);

/// The same for a kidnapping.
void tell(std::ostream& out, std::size_t number, const Kidnapping& kidnapping, const CarryVerdict& verdict);

/// A line a scan: what the localizer said, and how far off it was.
void trace(std::ostream& out, std::span<const ScanRecord> records);

}  // namespace beaconless::trust
