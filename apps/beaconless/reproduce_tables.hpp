// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "beaconless/report/html.hpp"

#include "reproduce_compare.hpp"
#include "reproduce_times.hpp"

/// The tables of the report. Positions in millimetres, headings in degrees; "–" where nothing was measured.
namespace beaconless::cli {

/// What stands in the caption of every table that is not the same twice.
inline constexpr std::string_view kMeasuredHere = "measured on this machine";

/// One of Tables 4.3 to 4.9: in each cell what was printed, what is measured on the tape-measured plan, and a
/// verdict.
report::Table published_table(const PublishedTable& published, std::span<const Comparison> comparisons);

/// The same rows on the exact plan and on the grid.
report::Table other_maps_table(const PublishedTable& published, std::span<const Comparison> comparisons);

/// RMSE of the position by method and scenario, with how many scans were degraded or lost.
report::Table overview_matrix(MapKind map, std::span<const Experiment> experiments,
                              std::span<const std::string> methods);

/// Everything about a map's experiments, a row each.
report::Table overview_table(MapKind map, std::span<const Experiment> experiments);

/// Where nothing drives: the constant part of the errors, and the rest.
report::Table offsets_table(std::span<const Experiment> experiments, std::span<const std::string> methods);

/// The three drives: errors, statuses, and how far apart start and end are.
report::Table drives_table(MapKind map, std::span<const Experiment> experiments,
                           std::span<const std::string> methods);

report::Table tapes_table(std::span<const TapeSpread> spreads, std::span<const Comparison> comparisons);

report::Table segmentation_times_table(const SegmentationTimes& times);
report::Table update_times_table(std::span<const Experiment> experiments,
                                 std::span<const std::string> methods);

/// A length for a cell: "21.4", "0.58"; millimetres.
std::string cell_mm(double metres);

}  // namespace beaconless::cli
