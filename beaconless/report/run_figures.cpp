// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/run_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr double kSpread_ratio = 50.0;     // of largest to median, above which an axis is logarithmic
constexpr double kLargestSigma_m = 100.0;  // more says "nothing is known"
constexpr double kLargestSigma_deg = 180.0;

const FloorPlan kNoWalls;

bool spreads(std::span<const double> values) {
  const double median = percentile(values, 0.5);
  return median > 0.0 && percentile(values, 1.0) > kSpread_ratio * median;
}

/// A plot of values that are never negative.
Plot over_time(const RunReport& report, const RunClock& clock, std::string y_title) {
  Plot plot;
  plot.x_title = clock.title();
  plot.y_title = std::move(y_title);
  plot.y_low = 0.0;
  plot.shades = status_shades(report, clock);
  return plot;
}

void choose_scale(Plot& plot) {
  plot.log_y = !plot.series.empty() && spreads(plot.series.front().y);
  if (!plot.log_y) return;
  plot.y_low = percentile(plot.series.front().y, 0.01);  // a lucky hit shall not stretch the axis by decades
  plot.y_title += ", log scale";
}

template <class Value>
Series error_series(const std::vector<PoseError>& errors, const RunClock& clock, Value value) {
  Series series;
  for (const PoseError& error : errors) {
    series.x.push_back(clock(error.stamp));
    series.y.push_back(value(error));
  }
  return series;
}

template <class Value>
Plot error_plot(const RunReport& report, const RunClock& clock, const std::string& y_title, Value value) {
  Plot plot = over_time(report, clock, y_title);
  plot.series.push_back(error_series(report.errors, clock, value));
  plot.series.back().name = "error";
  plot.series.back().mark = Mark::thin;
  if (!report.bounds.empty()) {
    plot.series.push_back(error_series(report.bounds, clock, value));
    plot.series.back().name = "Cramér–Rao bound, 1 sigma";
    plot.series.back().colour = Colour::ink;
  }
  choose_scale(plot);
  return plot;
}

/// One value an estimate that knows something; a gap where it does not.
template <class Value>
Series estimate_series(const RunReport& report, const RunClock& clock, Value value) {
  Series series;
  for (const PoseEstimate& estimate : report.estimates) {
    if (estimate.status == Status::not_a_scan) continue;
    series.x.push_back(clock(estimate.stamp));
    series.y.push_back(value(estimate));
  }
  return series;
}

/// What a gap means, where there is one.
Picture draw_with_gaps(const Plot& plot, const std::string& limit) {
  Picture picture = draw_plot(plot);
  const std::vector<double>& values = plot.series.front().y;
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    picture.note = "Gaps: more than " + limit + ", as good as nothing is known.";
  return picture;
}

double unless_above(double value, double limit) {
  return value <= limit ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Picture draw_run_map(const RunReport& report, const MapViewConfig& config) {
  return draw_map(report.map ? *report.map : Map{kNoWalls}, report.estimates,
                  report.reference.value_or(Trajectory{}), report.scans, config);
}

Picture draw_position_error(const RunReport& report, const RunClock& clock) {
  std::vector<double> values;
  for (const PoseError& error : report.errors) values.push_back(error.position_m);
  const LengthUnit unit = LengthUnit::for_axis(values);
  return draw_plot(error_plot(report, clock, "position error [" + unit.name + "]",
                              [&](const PoseError& e) { return unit.per_m * e.position_m; }));
}

Picture draw_heading_error(const RunReport& report, const RunClock& clock) {
  return draw_plot(
      error_plot(report, clock, "heading error [deg]", [](const PoseError& e) { return e.heading_deg; }));
}

Picture draw_position_sigma(const RunReport& report, const RunClock& clock) {
  Series series = estimate_series(report, clock, [](const PoseEstimate& e) {
    return unless_above(std::sqrt(e.covariance(0, 0) + e.covariance(1, 1)), kLargestSigma_m);
  });
  const LengthUnit unit = LengthUnit::for_axis(series.y);
  for (double& value : series.y) value *= unit.per_m;
  Plot plot = over_time(report, clock, "position, 1 sigma [" + unit.name + "]");
  plot.series.push_back(std::move(series));
  choose_scale(plot);
  return draw_with_gaps(plot, "100 m");
}

Picture draw_heading_sigma(const RunReport& report, const RunClock& clock) {
  Plot plot = over_time(report, clock, "heading, 1 sigma [deg]");
  plot.series.push_back(estimate_series(report, clock, [](const PoseEstimate& e) {
    return unless_above(degrees(std::sqrt(e.covariance(2, 2))), kLargestSigma_deg);
  }));
  choose_scale(plot);
  return draw_with_gaps(plot, "180 deg");
}

Picture draw_quality(const RunReport& report, const RunClock& clock) {
  Plot plot = over_time(report, clock, "quality: share of the scan that the map explains [1]");
  plot.y_high = 1.0;
  plot.series.push_back(estimate_series(report, clock, [](const PoseEstimate& e) { return e.quality; }));
  return draw_plot(plot);
}

Picture draw_update_times(const RunReport& report) {
  const double median = percentile(report.update_times_us, 0.5);
  const double p99 = percentile(report.update_times_us, 0.99);
  const bool in_ms = median >= 1000.0;
  const double factor = in_ms ? 1e-3 : 1.0;
  const std::string unit = in_ms ? "ms" : "µs";
  std::vector<double> values;
  for (const double time_us : report.update_times_us) values.push_back(factor * time_us);
  const std::vector<Level> markers{{factor * median, "median " + significant(factor * median) + " " + unit},
                                   {factor * p99, "p99 " + significant(factor * p99) + " " + unit}};
  return draw_histogram(values, "time of an update [" + unit + "]", "scans", markers);
}

}  // namespace beaconless::report
