// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/run_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/report/run_figures.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr std::size_t kMostPlaces = 60;  // rows of their table

std::vector<std::string> row_of(const std::string& name, const eval::Statistics& row, double factor) {
  // As many decimals for all as give the RMSE three digits and the median two: a row is read by comparing.
  const auto decimals_for = [&](double value, int digits) {
    if (!(value > 0.0) || !std::isfinite(value)) return 0;
    return digits - 1 - static_cast<int>(std::floor(std::log10(factor * value)));
  };
  const int decimals = std::clamp(std::max(decimals_for(row.rmse, 3), decimals_for(row.median, 2)), 0, 6);
  std::vector<std::string> cells{name};
  for (const double value : {row.mean, row.rmse, row.sd, row.max, row.min, row.median, row.p95})
    cells.push_back(std::isfinite(value) ? fmt::format("{:.{}f}", factor * value, decimals) : "–");
  return cells;
}

}  // namespace

Table error_table(const RunReport& report) {
  Table table{"Error against the reference", {"", "mean", "RMSE", "SD", "max", "min", "median", "p95"}, {}};
  const auto add = [&](const eval::ErrorTable& error, const std::string& how) {
    const LengthUnit unit = LengthUnit::for_size(error.position_m.rmse);
    table.rows.push_back(row_of("position [" + unit.name + "], " + how, error.position_m, unit.per_m));
    table.rows.push_back(row_of("heading [deg], " + how, error.heading_deg, 1.0));
  };
  if (report.error) add(*report.error, "as it is");
  if (report.error_aligned) add(*report.error_aligned, "aligned");
  return table;
}

Table places_table(const RunReport& report) {
  Table table{"Places that fitted",
              {"time [s]", "scan", "place", "x [m]", "y [m]", "heading [deg]", "score", "weight"},
              {}};
  for (const CandidatePlaces& fitted : report.places)
    for (std::size_t i = 0; i < fitted.places.size() && table.rows.size() < kMostPlaces; ++i) {
      const CandidatePlace& place = fitted.places[i];
      const double at_s =
          report.estimates.empty() ? 0.0 : seconds_between(report.estimates.front().stamp, fitted.stamp);
      table.rows.push_back({number(at_s, 2), std::to_string(fitted.scan_index), std::to_string(i + 1),
                            number(place.map_from_base.x_m, 2), number(place.map_from_base.y_m, 2),
                            number(degrees(place.map_from_base.theta_rad), 1), number(place.score, 2),
                            number(place.weight, 2)});
    }
  return table;
}

}  // namespace beaconless::report
