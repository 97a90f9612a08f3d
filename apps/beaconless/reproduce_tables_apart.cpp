// SPDX-License-Identifier: Apache-2.0
// Tables that tell what is constant from what scatters, and those of times.
#include <cmath>

#include <fmt/format.h>

#include "reproduce_tables.hpp"

namespace beaconless::cli {
namespace {

constexpr const char* kNothing = "–";

std::string microseconds(double us) { return fmt::format("{:.{}f}", us, us < 100.0 ? 1 : 0); }

}  // namespace

report::Table offsets_table(std::span<const Experiment> experiments, std::span<const std::string> methods) {
  report::Table table;
  table.caption =
      "Length of the mean error vector ± root mean square of what is left of x and y together [mm]; on the "
      "tape-measured plan also that vector itself and the mean error of the heading";
  table.columns = {"Scenario and method", "exact plan", "tape-measured plan", "5 cm grid",
                   "tape: room x, y",     "robot x, y", "heading [°]"};
  for (const std::string_view scenario : reproduced_scenarios().first(4))
    for (const std::string& method : methods) {
      auto& row = table.rows.emplace_back();
      row.push_back(std::string(scenario) + ", " + method);
      for (const MapKind map : kMapKinds) {
        const Experiment* e = find(experiments, scenario, map, method);
        row.push_back(e == nullptr ? kNothing
                                   : cell_mm(e->offset.norm_m()) + " ± " + cell_mm(e->offset.scatter_m));
      }
      const Experiment* e = find(experiments, scenario, MapKind::tape, method);
      if (e == nullptr) {
        row.resize(table.columns.size(), kNothing);
        continue;
      }
      row.push_back(cell_mm(e->offset.x_m) + ", " + cell_mm(e->offset.y_m));
      row.push_back(cell_mm(e->offset.along_m) + ", " + cell_mm(e->offset.across_m));
      row.push_back(fmt::format("{:.3f} ± {:.3f}", e->offset.heading_deg, e->offset.scatter_deg));
    }
  return table;
}

report::Table tapes_table(std::span<const TapeSpread> spreads, std::span<const Comparison> comparisons) {
  report::Table table;
  table.caption = fmt::format("How much of it is the luck of one tape: the mean error on {} others",
                              spreads.empty() ? 0 : spreads.front().mean_m.size());
  table.columns = {"Table and method",       "printed", "this tape", "10 % of the tapes", "median", "90 %",
                   "at or below the printed"};
  for (const Comparison& comparison : comparisons) {
    const TapeSpread* spread = find(spreads, comparison.table->scenario, comparison.row->method);
    if (spread == nullptr || comparison.on(MapKind::tape) == nullptr) continue;
    const Quantity quantity = comparison.table->quantity;
    const auto& means = spread->means(quantity);
    const auto at = [&](double share) { return TapeSpread::quantile(means, share); };
    table.rows.push_back(
        {fmt::format("{}, {}", comparison.table->number, comparison.row->method),
         with_unit(comparison.row->mean, quantity),
         with_unit(comparison.value(MapKind::tape, Statistic::mean), quantity), with_unit(at(0.1), quantity),
         with_unit(at(0.5), quantity), with_unit(at(0.9), quantity),
         fmt::format("{:.0f} %", 100.0 * TapeSpread::share_up_to(means, comparison.row->mean))});
  }
  return table;
}

report::Table segmentation_times_table(const SegmentationTimes& times) {
  report::Table table;
  table.caption =
      fmt::format("Table 4.2: computation time of a scan, printed (Matlab) → median, {}", kMeasuredHere);
  table.columns = {"Approach"};
  for (const double epsilon_m : kTable42Epsilons_m)
    table.columns.push_back(fmt::format("epsilon = {:.2f} m", epsilon_m));
  for (std::size_t r = 0; r < kTable42.size(); ++r) {
    auto& row = table.rows.emplace_back();
    row.emplace_back(kTable42[r].label);
    for (std::size_t c = 0; c < kTable42Epsilons_m.size(); ++c)
      row.push_back(fmt::format("{:.1f} ms → {} µs", 1e3 * kTable42[r].seconds[c],
                                microseconds(times.median_us[r][c])));
  }
  return table;
}

report::Table update_times_table(std::span<const Experiment> experiments,
                                 std::span<const std::string> methods) {
  report::Table table;
  table.caption = fmt::format(
      "A whole update, median and 99th percentile in microseconds a scan of room-ellipse, {}", kMeasuredHere);
  table.columns = {"Here"};
  for (const MapKind map : kMapKinds) {
    table.columns.push_back(fmt::format("{}: median", words(map)));
    table.columns.emplace_back("99 %");
  }
  for (const std::string& method : methods) {
    auto& row = table.rows.emplace_back();
    row.push_back(method);
    for (const MapKind map : kMapKinds) {
      const Experiment* e = find(experiments, "room-ellipse", map, method);
      row.push_back(e == nullptr ? kNothing : microseconds(e->median_us));
      row.push_back(e == nullptr ? kNothing : microseconds(e->p99_us));
    }
  }
  return table;
}

}  // namespace beaconless::cli
