// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reproduce_published.hpp"
#include "reproduce_scenes.hpp"

namespace beaconless::cli {

/// What a method's mean error is on many tapes: one tape is one draw, and its offset is luck.
struct TapeSpread {
  std::string scenario;
  std::string method;
  std::vector<double> mean_m;    ///< of the position, one a tape, ascending
  std::vector<double> mean_deg;  ///< of the heading, likewise

  const std::vector<double>& means(Quantity quantity) const {
    return quantity == Quantity::position ? mean_m : mean_deg;
  }

  /// The share of the tapes on which the mean is at or below a value.
  static double share_up_to(std::span<const double> ascending, double value);
  /// The value that a share of the tapes stays at or below. In: at least one tape.
  static double quantile(std::span<const double> ascending, double share);
};

/// Measures the rooms that stand in the dissertation's tables with further tapes, seeds `first_seed` on, and
/// localizes a few scans of each on them, every one from its true pose. Methods that a plan refuses are left
/// out.
std::vector<TapeSpread> run_tapes(const Console& console, std::span<const Scene> scenes,
                                  std::span<const std::string> methods, int first_seed, int tapes);

const TapeSpread* find(std::span<const TapeSpread> spreads, std::string_view scenario,
                       std::string_view method);

}  // namespace beaconless::cli
