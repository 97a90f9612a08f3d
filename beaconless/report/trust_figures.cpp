// SPDX-License-Identifier: Apache-2.0
// What the estimates said of themselves, against how it was.
#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/report/run_figures.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallest = 1e-4;  // of an axis of errors, metres or degrees: nobody looks below

/// Levels over time, and errors below them; a gap where nothing bounds the error.
template <class OfEstimate, class OfJudged>
Picture draw_protection(const RunReport& report, const RunClock& clock, const std::string& y_title,
                        OfEstimate level_of, OfJudged error_of) {
  Series level{"protection level", Colour::ink, Mark::line, {}, {}};
  for (const PoseEstimate& estimate : report.estimates) {
    if (estimate.status == Status::not_a_scan) continue;
    level.x.push_back(clock(estimate.stamp));
    level.y.push_back(level_of(estimate));
  }
  Series error{"error", Colour::blue, Mark::thin, {}, {}};
  for (const eval::JudgedEstimate& judged : report.judged) {
    error.x.push_back(clock(judged.stamp));
    error.y.push_back(std::max(error_of(judged), kSmallest));
  }
  Plot plot;
  plot.x_title = clock.title();
  plot.y_title = y_title + ", log scale";
  plot.log_y = true;
  plot.shades = status_shades(report, clock);
  if (!error.x.empty()) plot.series.push_back(std::move(error));
  plot.series.push_back(std::move(level));
  Picture picture = draw_plot(plot);
  const eval::Trust trust = eval::trust_of(report.judged);
  if (trust.bounded_count > 0)
    picture.note = grouped(trust.violation_count) + " of " + grouped(trust.bounded_count) +
                   " poses are further off than their protection level says, in position or heading.";
  return picture;
}

}  // namespace

Picture draw_position_protection(const RunReport& report, const RunClock& clock) {
  return draw_protection(
      report, clock, "position [m]",
      [](const PoseEstimate& e) {
        return e.protection_m < PoseEstimate::kUnbounded_m ? e.protection_m : kNothing;
      },
      [](const eval::JudgedEstimate& e) { return e.position_error_m; });
}

Picture draw_heading_protection(const RunReport& report, const RunClock& clock) {
  return draw_protection(
      report, clock, "heading [deg]",
      [](const PoseEstimate& e) { return e.protection_rad < kPi ? degrees(e.protection_rad) : kNothing; },
      [](const eval::JudgedEstimate& e) { return degrees(e.heading_error_rad); });
}

Picture draw_reliability(const RunReport& report) {
  const eval::Trust trust = eval::trust_of(report.judged);
  Plot plot;
  plot.x_title = "quality [1]";
  plot.y_title = "share within " + number(100.0 * eval::kTrusted_m) + " cm and " +
                 number(eval::kTrusted_deg) + " deg [1]";
  plot.y_low = 0.0;
  plot.y_high = 1.0;
  Series share{"share of the poses of this quality", Colour::blue, Mark::line, {}, {}};
  Series dots{"", Colour::blue, Mark::dots, {}, {}};
  for (const eval::QualityBin& bin : trust.bins) {
    const double of_bin =
        bin.count == 0 ? kNothing : static_cast<double>(bin.near_count) / static_cast<double>(bin.count);
    for (Series* series : {&share, &dots}) {
      series->x.push_back(0.5 * (bin.low + bin.high));
      series->y.push_back(of_bin);
    }
  }
  plot.series = {
      Series{"a quality that is a probability", Colour::grey, Mark::dashed, {0.0, 1.0}, {0.0, 1.0}},
      std::move(share), std::move(dots)};
  Picture picture = draw_plot(plot);
  for (const eval::QualityBin& bin : trust.bins)
    if (bin.count > 0)
      picture.note += (picture.note.empty() ? "Poses of each tenth: " : ", ") + grouped(bin.count);
  picture.note += picture.note.empty() ? "" : ".";
  return picture;
}

}  // namespace beaconless::report
