// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reproduce_experiments.hpp"
#include "reproduce_published.hpp"
#include "reproduce_tapes.hpp"

namespace beaconless::cli {

/// The columns of the dissertation's tables.
enum class Statistic : int { mean, rmse, sd, max, min };

inline constexpr std::array kStatistics{Statistic::mean, Statistic::rmse, Statistic::sd, Statistic::max,
                                        Statistic::min};

std::string_view name_of(Statistic statistic);
double value_of(const PublishedRow& row, Statistic statistic);
double value_of(const eval::Statistics& statistics, Statistic statistic);

/// A printed row and what this program measured.
struct Comparison {
  const PublishedTable* table = nullptr;
  const PublishedRow* row = nullptr;
  std::array<const Experiment*, kMapKinds.size()> measured{};  ///< nullptr where there is none

  const Experiment* on(MapKind map) const { return measured[static_cast<std::size_t>(map)]; }

  /// In metres or degrees, as printed. In: there must be an experiment on that map.
  double value(MapKind map, Statistic statistic) const;

  /// At or below the printed figure, to the four digits in which it was printed.
  bool is_at_or_below(MapKind map, Statistic statistic) const;

  /// Whether the method itself found nine tenths of the poses or more, and did not coast or have the whole
  /// scan stand in for it. In: there must be an experiment on that map.
  bool is_own(MapKind map) const;
};

/// One for each row of Tables 4.3 to 4.9, in their order. Points into `experiments`.
std::vector<Comparison> compare(std::span<const Experiment> experiments);

/// Why the mean or the RMSE on the tape-measured plan is above the printed one: how much of the error is
/// constant, what is left without the tape's errors, and how often another tape would be kinder. "" where
/// both are at or below, or nothing was measured.
std::string why_above(const Comparison& comparison, std::span<const TapeSpread> spreads);

/// What a reader must know who would take the figures on the tape-measured plan for a method's: that it
/// mostly coasted on its prediction, which flatters a robot that stands where it began. "" where it did not.
std::string caution(const Comparison& comparison);

/// A length in millimetres or an angle in degrees, with its unit: "9.1 mm", "0.123°".
std::string with_unit(double value, Quantity quantity);

}  // namespace beaconless::cli
