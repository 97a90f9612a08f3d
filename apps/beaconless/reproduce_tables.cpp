// SPDX-License-Identifier: Apache-2.0
#include "reproduce_tables.hpp"

#include <cmath>

#include <fmt/format.h>

namespace beaconless::cli {
namespace {

constexpr const char* kNothing = "–";

std::string cell(double value, Quantity quantity) {
  return quantity == Quantity::position ? cell_mm(value) : fmt::format("{:.3f}", value);
}

std::string printed_cell(double value, Quantity quantity) {
  return quantity == Quantity::position ? fmt::format("{:.1f}", 1e3 * value) : fmt::format("{:.4f}", value);
}

std::string_view unit_of(Quantity quantity) { return quantity == Quantity::position ? "mm" : "°"; }

std::string states(const Experiment& e) {
  return fmt::format("{} / {} / {}", e.ok_count, e.degraded_count, e.lost_count);
}

/// ", 12d, 3l": the scans that were not ok, for the end of a cell.
std::string not_ok(const Experiment& e) {
  return (e.degraded_count == 0 ? "" : fmt::format(", {}d", e.degraded_count)) +
         (e.lost_count == 0 ? "" : fmt::format(", {}l", e.lost_count));
}

}  // namespace

std::string cell_mm(double metres) {
  return fmt::format("{:.{}f}", 1e3 * metres, std::abs(metres) < 9.995e-3 ? 2 : 1);
}

report::Table published_table(const PublishedTable& published, std::span<const Comparison> comparisons) {
  report::Table table;
  table.caption = fmt::format(
      "Table {}: {} [{}], printed → measured on the tape-measured plan; ✓ at or below, (✓) so too, but the "
      "method itself found fewer than nine tenths of the poses, ▲ above",
      published.number, published.caption, unit_of(published.quantity));
  table.columns = {"Method", "Here"};
  for (const Statistic statistic : kStatistics) table.columns.emplace_back(name_of(statistic));
  for (const Comparison& comparison : comparisons) {
    if (comparison.table != &published) continue;
    auto& row = table.rows.emplace_back();
    row = {std::string(comparison.row->label), std::string(comparison.row->method)};
    for (const Statistic statistic : kStatistics)
      row.push_back(printed_cell(value_of(*comparison.row, statistic), published.quantity) + " → " +
                    (comparison.on(MapKind::tape) == nullptr
                         ? kNothing
                         : cell(comparison.value(MapKind::tape, statistic), published.quantity) +
                               (!comparison.is_at_or_below(MapKind::tape, statistic) ? " ▲"
                                : comparison.is_own(MapKind::tape)                   ? " ✓"
                                                                                     : " (✓)")));
  }
  return table;
}

report::Table other_maps_table(const PublishedTable& published, std::span<const Comparison> comparisons) {
  report::Table table;
  table.caption = fmt::format("The same on the other two maps [{}]", unit_of(published.quantity));
  table.columns = {"Here"};
  for (const MapKind map : {MapKind::exact, MapKind::grid})
    for (const Statistic statistic : kStatistics)
      table.columns.push_back(statistic == Statistic::mean
                                  ? fmt::format("{}: {}", words(map), name_of(statistic))
                                  : std::string(name_of(statistic)));
  for (const Comparison& comparison : comparisons) {
    if (comparison.table != &published) continue;
    auto& row = table.rows.emplace_back();
    row.emplace_back(comparison.row->method);
    for (const MapKind map : {MapKind::exact, MapKind::grid})
      for (const Statistic statistic : kStatistics)
        row.push_back(comparison.on(map) == nullptr
                          ? kNothing
                          : cell(comparison.value(map, statistic), published.quantity));
  }
  return table;
}

report::Table overview_matrix(MapKind map, std::span<const Experiment> experiments,
                              std::span<const std::string> methods) {
  report::Table table;
  table.caption = fmt::format("On the {}: RMSE of the position [mm]; d scans degraded, l lost", words(map));
  table.columns = {"Here"};
  for (const std::string_view scenario : reproduced_scenarios()) table.columns.emplace_back(scenario);
  for (const std::string& method : methods) {
    auto& row = table.rows.emplace_back();
    row.push_back(method);
    for (const std::string_view scenario : reproduced_scenarios()) {
      const Experiment* e = find(experiments, scenario, map, method);
      row.push_back(e == nullptr ? kNothing : cell_mm(e->table.position_m.rmse) + not_ok(*e));
    }
  }
  return table;
}

report::Table overview_table(MapKind map, std::span<const Experiment> experiments) {
  report::Table table;
  table.caption = fmt::format("On the {}: position [mm], heading [°], scans by status", words(map));
  table.columns = {
      "Scenario and method",  "mean",        "RMSE", "SD", "max", "min", "heading mean", "RMSE", "max",
      "ok / degraded / lost", "max while ok"};
  for (const Experiment& e : experiments) {
    if (e.map != map) continue;
    auto& row = table.rows.emplace_back();
    row.push_back(e.scenario + ", " + e.method);
    if (!e.refused.empty()) {
      row.push_back("refused: " + e.refused);
      row.resize(table.columns.size());
      continue;
    }
    for (const Statistic statistic : kStatistics)
      row.push_back(cell(value_of(e.table.position_m, statistic), Quantity::position));
    for (const Statistic statistic : {Statistic::mean, Statistic::rmse, Statistic::max})
      row.push_back(cell(value_of(e.table.heading_deg, statistic), Quantity::heading));
    row.push_back(states(e));
    row.push_back(e.ok_count == 0 ? kNothing : cell_mm(e.max_ok_m));
  }
  return table;
}

report::Table drives_table(MapKind map, std::span<const Experiment> experiments,
                           std::span<const std::string> methods) {
  report::Table table;
  table.caption = fmt::format(
      "The drives on the {}: RMSE and largest error of the position, and the gap between the first estimate "
      "and the last, where the robot itself returns exactly [mm]; d scans degraded, l lost",
      words(map));
  table.columns = {"Here"};
  for (const std::string_view scenario : reproduced_scenarios().subspan(4))
    table.columns.emplace_back(scenario);
  for (const std::string& method : methods) {
    auto& row = table.rows.emplace_back();
    row.push_back(method);
    for (const std::string_view scenario : reproduced_scenarios().subspan(4)) {
      const Experiment* e = find(experiments, scenario, map, method);
      row.push_back(e == nullptr
                        ? kNothing
                        : fmt::format("{}, {}, gap {}{}", cell_mm(e->table.position_m.rmse),
                                      cell_mm(e->table.position_m.max), cell_mm(e->closure_m), not_ok(*e)));
    }
  }
  return table;
}

}  // namespace beaconless::cli
