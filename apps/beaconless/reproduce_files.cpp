// SPDX-License-Identifier: Apache-2.0
// The numbers as files beside the page.
#include <iterator>

#include <fmt/format.h>

#include "reproduce_tables.hpp"
#include "reproduction.hpp"

namespace beaconless::cli {
namespace {

/// In a Markdown table a bar ends the cell.
std::string markdown(const report::Table& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
  };
  std::string rule = "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) rule += i == 0 ? "---|" : "---:|";
  std::string text = "**" + table.caption + "**\n\n" + line(table.columns) + rule + "\n";
  for (const auto& row : table.rows) text += line(row);
  return text + "\n";
}

std::string number(double value) { return fmt::format("{:.9g}", value); }

std::string tables_csv(const Reproduction& r) {
  std::string text = "table,scenario,label,method,quantity,statistic,printed,tape,exact,grid,verdict\n";
  for (const Comparison& comparison : r.comparisons)
    for (const Statistic statistic : kStatistics) {
      const auto measured = [&](MapKind map) {
        return comparison.on(map) == nullptr ? std::string() : number(comparison.value(map, statistic));
      };
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{}\n", comparison.table->number,
                     comparison.table->scenario, comparison.row->label, comparison.row->method,
                     comparison.table->quantity == Quantity::position ? "position_m" : "heading_deg",
                     name_of(statistic), number(value_of(*comparison.row, statistic)),
                     measured(MapKind::tape), measured(MapKind::exact), measured(MapKind::grid),
                     comparison.on(MapKind::tape) == nullptr               ? "missing"
                     : comparison.is_at_or_below(MapKind::tape, statistic) ? "at_or_below"
                                                                           : "above");
    }
  return text;
}

std::string overview_csv(const Reproduction& r) {
  std::string text =
      "map,scenario,method,scans,ok,degraded,lost,mean_m,rmse_m,sd_m,max_m,min_m,max_ok_m,mean_deg,rmse_deg,"
      "sd_deg,max_deg,min_deg,offset_x_m,offset_y_m,offset_along_m,offset_across_m,offset_deg,scatter_m,"
      "scatter_deg,gap_m,refused\n";
  for (const Experiment& e : r.experiments) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}", name_of(e.map), e.scenario, e.method,
                   e.errors.size(), e.ok_count, e.degraded_count, e.lost_count);
    for (const Statistic statistic : kStatistics)
      text += "," + number(value_of(e.table.position_m, statistic));
    text += "," + number(e.max_ok_m);
    for (const Statistic statistic : kStatistics)
      text += "," + number(value_of(e.table.heading_deg, statistic));
    for (const double value : {e.offset.x_m, e.offset.y_m, e.offset.along_m, e.offset.across_m,
                               e.offset.heading_deg, e.offset.scatter_m, e.offset.scatter_deg, e.closure_m})
      text += "," + number(value);
    text += ",\"" + e.refused + "\"\n";
  }
  return text;
}

std::string tapes_csv(const Reproduction& r) {
  std::string text = "scenario,method,rank,mean_m,mean_deg\n";
  for (const TapeSpread& spread : r.tapes)
    for (std::size_t i = 0; i < spread.mean_m.size(); ++i)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", spread.scenario, spread.method, i,
                     number(spread.mean_m[i]), number(spread.mean_deg[i]));
  return text;
}

std::string times_csv(const Reproduction& r) {
  std::string text = "what,map,scenario,printed_s,median_us,p99_us\n";
  for (std::size_t row = 0; row < kTable42.size(); ++row)
    for (std::size_t c = 0; c < kTable42Epsilons_m.size(); ++c)
      fmt::format_to(std::back_inserter(text), "\"{}, epsilon = {:.2f}\",,room-position-2,{},{:.3f},\n",
                     kTable42[row].label, kTable42Epsilons_m[c], number(kTable42[row].seconds[c]),
                     r.times.median_us[row][c]);
  for (const Experiment& e : r.experiments)
    if (e.refused.empty())
      fmt::format_to(std::back_inserter(text), "{},{},{},,{:.3f},{:.3f}\n", e.method, name_of(e.map),
                     e.scenario, e.median_us, e.p99_us);
  return text;
}

}  // namespace

std::string markdown(const Reproduction& r) {
  std::string text =
      "# The experiments of the dissertation, again\n\nEvery scan is simulated, in rooms whose dimensions "
      "were chosen for this project. Beside the printed figures stands what was measured on plans with a "
      "tape's errors.\n\n";
  if (r.is_quick) text += "This is a quick run: only the first half second of each scenario.\n\n";
  for (const std::string& finding : findings_of(r)) text += "- " + finding + "\n";
  for (const std::string& method : r.methods.left_out) text += "- Left out: " + method + ".\n";
  text += "\n";
  for (const PublishedTable& table : kPublishedTables)
    text += markdown(published_table(table, r.comparisons));
  for (const Comparison& comparison : r.comparisons)
    for (const std::string& words : {why_above(comparison, r.tapes), caution(comparison)})
      if (!words.empty()) text += "- " + words + "\n";
  text += "\n";
  for (const MapKind map : kMapKinds)
    text += markdown(overview_matrix(map, r.experiments, r.methods.present));
  return r.tapes.empty() ? text : text + markdown(tapes_table(r.tapes, r.comparisons));
}

std::vector<TextFile> csv_files(const Reproduction& r) {
  return {{"tables.csv", tables_csv(r)},
          {"overview.csv", overview_csv(r)},
          {"tapes.csv", tapes_csv(r)},
          {"times.csv", times_csv(r)}};
}

}  // namespace beaconless::cli
