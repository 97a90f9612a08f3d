// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "bench/trust/trial.hpp"

namespace beaconless::trust {

/// Scans of a trial from one to before another; the events between them belong to them.
struct TrialPart {
  const Trial* of = nullptr;
  std::size_t first = 0;
  std::size_t end = 0;
};

/// A robot that is carried: a part of one trial, then at once a part of another (or the same) at another
/// place.
///
/// Stamps go on evenly: the first scan after the carry comes one typical period of the first part after its
/// last. Odometry goes on too, and does not tell the carry. The map and everything else is that of the first;
/// it starts at its truth. In: parts of at least two scans and one.
Trial splice(const TrialPart& before, const TrialPart& after);

/// Scan `i` of a trial.
const Scan& scan_of(const Trial& trial, std::size_t i);

}  // namespace beaconless::trust
