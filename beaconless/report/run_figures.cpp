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

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

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

/// One value an error, and one a bound where there are bounds; a gap where a scan has none.
template <class OfError, class OfBound>
Plot error_plot(const RunReport& report, const RunClock& clock, const std::string& y_title, OfError of_error,
                OfBound of_bound) {
  Plot plot = over_time(report, clock, y_title);
  Series error{"error", Colour::blue, Mark::thin, {}, {}};
  Series bound{"Cramér–Rao bound, 1 sigma", Colour::ink, Mark::line, {}, {}};
  for (std::size_t i = 0; i < report.errors.size(); ++i) {
    const double at = clock(report.errors[i].stamp);
    error.x.push_back(at);
    error.y.push_back(of_error(report.errors[i]));
    bound.x.push_back(at);
    bound.y.push_back(i < report.bounds.size() && report.bounds[i] ? of_bound(*report.bounds[i]) : kNothing);
  }
  plot.series.push_back(std::move(error));
  if (!report.bounds.empty()) plot.series.push_back(std::move(bound));
  choose_scale(plot);
  return plot;
}

double position_sigma_m(const Eigen::Matrix3d& covariance) {
  return std::sqrt(covariance(0, 0) + covariance(1, 1));
}

double heading_sigma_deg(const Eigen::Matrix3d& covariance) { return degrees(std::sqrt(covariance(2, 2))); }

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

double unless_above(double value, double limit) { return value <= limit ? value : kNothing; }

}  // namespace

Picture draw_run_map(const RunReport& report, const MapViewConfig& config) {
  return draw_map(report.map ? *report.map : Map{kNoWalls}, report.estimates,
                  report.reference.value_or(Trajectory{}), report.scans, marks_of(report), config);
}

Picture draw_position_error(const RunReport& report, const RunClock& clock) {
  std::vector<double> values_m;
  for (const eval::PoseError& error : report.errors) values_m.push_back(error.position_m());
  const LengthUnit unit = LengthUnit::for_axis(values_m);
  return draw_plot(error_plot(
      report, clock, "position error [" + unit.name + "]",
      [&](const eval::PoseError& e) { return unit.per_m * e.position_m(); },
      [&](const Eigen::Matrix3d& bound) { return unit.per_m * position_sigma_m(bound); }));
}

Picture draw_heading_error(const RunReport& report, const RunClock& clock) {
  return draw_plot(error_plot(
      report, clock, "heading error [deg]",
      [](const eval::PoseError& e) { return std::abs(degrees(e.heading_rad)); }, heading_sigma_deg));
}

Picture draw_position_sigma(const RunReport& report, const RunClock& clock) {
  Series series = estimate_series(report, clock, [](const PoseEstimate& e) {
    return unless_above(position_sigma_m(e.covariance), kLargestSigma_m);
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
    return unless_above(heading_sigma_deg(e.covariance), kLargestSigma_deg);
  }));
  choose_scale(plot);
  return draw_with_gaps(plot, "180 deg");
}

Picture draw_quality(const RunReport& report, const RunClock& clock) {
  Plot plot = over_time(report, clock, "quality [1]");
  plot.y_high = 1.0;
  plot.level = Level{eval::kTrusted_quality, "trusted from here on"};
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
