// SPDX-License-Identifier: Apache-2.0
// Figures 4.10 to 4.13: the error of the position against the scan.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/report/plot.hpp"

#include "reproduce_figures.hpp"
#include "reproduce_published.hpp"

namespace beaconless::cli {
namespace {

using report::Colour;
using report::Mark;
using report::Series;

/// A figure of the dissertation: which methods of which table it shows, and what it said.
struct Group {
  std::string_view number;
  const PublishedTable* table = nullptr;
  std::size_t first_row = 0;
  std::string_view said;
};

constexpr std::size_t kRows = 4;
constexpr double kTop_mm = 100.0;

constexpr std::array<Group, 4> kGroups{{
    {"4.10", kPublishedTables.data(), 0,
     "Small room, standing. In the dissertation corners from Douglas-Peucker alone do worst, the full scan "
     "varies least but lies 2 cm off, corners from line intersections do best."},
    {"4.11", kPublishedTables.data(), 4,
     "Small room, standing. In the dissertation FALKO does best of the four, with much scatter."},
    {"4.12", kPublishedTables.data() + 2, 0,
     "Small room, turning by 360°. In the dissertation the error jumps whenever a corner comes into view or "
     "leaves it, up to 14 cm with corners from Douglas-Peucker."},
    {"4.13", kPublishedTables.data() + 2, 4,
     "Small room, turning by 360°. In the dissertation FALKO does best of the four and all are worse than "
     "standing."},
}};

Series series_of(const Experiment& experiment, Colour colour) {
  Series series{.name = std::string(words(experiment.map)), .colour = colour, .mark = Mark::thin};
  series.x.reserve(experiment.errors.size());
  series.y.reserve(experiment.errors.size());
  for (std::size_t i = 0; i < experiment.errors.size(); ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(1e3 * experiment.errors[i].position_m());
  }
  return series;
}

double largest_of(std::span<const Series> series) {
  double largest = 0.0;
  for (const Series& one : series)
    for (const double value : one.y) largest = std::max(largest, value);
  return largest;
}

/// A method's error on the tape-measured and on the exact plan; the printed mean is a dashed line.
Figure::Part part_of(const PublishedTable& table, const PublishedRow& row,
                     std::span<const Experiment> experiments) {
  report::Plot plot{.x_title = "scan", .y_title = "position error [mm]", .log_y = true, .y_low = 0.1};
  for (const auto& [map, colour] : {std::pair{MapKind::exact, Colour::green}, {MapKind::tape, Colour::blue}})
    if (const Experiment* experiment = find(experiments, table.scenario, map, row.method))
      plot.series.push_back(series_of(*experiment, colour));
  plot.y_high = std::max(kTop_mm, largest_of(plot.series));
  plot.level = report::Level{1e3 * row.mean, fmt::format("printed mean {:.1f} mm", 1e3 * row.mean)};
  std::string caption =
      fmt::format("{} ({}). Printed largest {:.1f} mm", row.label, row.method, 1e3 * row.max);
  if (const Experiment* experiment = find(experiments, table.scenario, MapKind::tape, row.method))
    caption +=
        fmt::format(", here {:.1f} mm on the tape-measured plan.", 1e3 * experiment->table.position_m.max);
  else
    caption += "; left out of this run.";
  return {caption, report::draw_plot(plot, {.width_px = 560.0, .height_px = 250.0})};
}

}  // namespace

std::vector<Figure> error_figures(std::span<const Experiment> experiments) {
  std::vector<Figure> figures;
  figures.reserve(kGroups.size());
  for (const Group& group : kGroups) {
    Figure& figure = figures.emplace_back();
    figure.caption =
        fmt::format("Figure {}. Error of the position against the scan. {}", group.number, group.said);
    for (const PublishedRow& row : group.table->rows.subspan(group.first_row, kRows))
      figure.parts.push_back(part_of(*group.table, row, experiments));
  }
  return figures;
}

}  // namespace beaconless::cli
