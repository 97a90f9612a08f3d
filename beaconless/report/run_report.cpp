// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/run_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/report/html.hpp"
#include "beaconless/report/run_figures.hpp"
#include "beaconless/report/run_tables.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr std::size_t kMostProblems = 200;
constexpr double kFewLost_ratio = 0.05;
constexpr double kStep_m = 0.05;
constexpr std::array kStatuses{Status::ok, Status::degraded, Status::relocalizing, Status::lost,
                               Status::not_started};

/// How many scans ended in each status; events without a scan are not counted.
struct Counts {
  std::array<std::size_t, kStatuses.size()> of{};
  std::size_t scans = 0;

  explicit Counts(const RunReport& report) {
    for (const PoseEstimate& estimate : report.estimates)
      for (std::size_t i = 0; i < kStatuses.size(); ++i)
        if (estimate.status == kStatuses[i]) {
          ++of[i];
          ++scans;
        }
  }
  std::size_t ok() const { return of[0]; }
  std::size_t lost() const {
    return of[static_cast<std::size_t>(std::find(kStatuses.begin(), kStatuses.end(), Status::lost) -
                                       kStatuses.begin())];
  }
};

std::string percent(std::size_t part, std::size_t whole) {
  if (part == 0 || part == whole) return part == 0 ? "0 %" : "100 %";
  // 99.96 % is not 100 %: rounding must not hide the scan that failed, nor the only one that did not.
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  return fmt::format("{:.1f} %", std::clamp(share, 0.1, 99.9));
}

std::string length(double value_m) {
  const LengthUnit unit = LengthUnit::for_size(value_m);
  return significant(unit.per_m * value_m, 2) + " " + unit.name;
}

std::string verdict_words(const RunReport& report, const Counts& counts) {
  if (counts.scans == 0) return "No scan was localized: the recording gave none.";
  std::string verdict = grouped(counts.ok()) + " of " + grouped(counts.scans) + " scans localized";
  for (std::size_t i = 1; i < kStatuses.size(); ++i)
    if (counts.of[i] > 0) verdict += ", " + grouped(counts.of[i]) + " " + words(kStatuses[i]);
  if (report.error) {
    verdict += "; position RMSE " + length(report.error->position_m.rmse) + " against the reference";
    if (report.bound_ratio && std::isfinite(report.bound_ratio->position))
      verdict += ", " + significant(report.bound_ratio->position, 2) + " times the Cramér–Rao bound";
  }
  return verdict + ".";
}

Verdict verdict_of(const Counts& counts) {
  if (counts.scans == 0 ||
      static_cast<double>(counts.scans - counts.ok()) > 0.5 * static_cast<double>(counts.scans) ||
      static_cast<double>(counts.lost()) > kFewLost_ratio * static_cast<double>(counts.scans))
    return Verdict::bad;
  return counts.ok() == counts.scans ? Verdict::good : Verdict::mixed;
}

std::string times_the_bound(const RunReport& report, double eval::CrbRatio::*which) {
  if (!report.bound_ratio || !std::isfinite((*report.bound_ratio).*which)) return "";
  return significant((*report.bound_ratio).*which) + " times the Cramér–Rao bound";
}

/// What was driven, by the poses that can be trusted; what is less than a step is noise of a robot that
/// stands.
double driven_m(const RunReport& report) {
  double sum = 0.0;
  const PoseEstimate* last = nullptr;
  for (const PoseEstimate& estimate : report.estimates) {
    if (!estimate.ok() || !estimate.map_from_base.is_finite()) continue;
    const double step = last == nullptr ? kStep_m : distance_m(last->map_from_base, estimate.map_from_base);
    if (step < kStep_m) continue;
    if (last != nullptr) sum += step;
    last = &estimate;
  }
  return sum;
}

std::vector<Card> cards_of(const RunReport& report, const Counts& counts, const RunClock& clock) {
  std::vector<Card> cards{{"scans localized", grouped(counts.ok()), "of " + grouped(counts.scans),
                           percent(counts.ok(), counts.scans)}};
  if (report.error) {
    const eval::ErrorTable& error = *report.error;
    const LengthUnit unit = LengthUnit::for_size(error.position_m.rmse);
    cards.push_back({"position error, RMSE", significant(unit.per_m * error.position_m.rmse), unit.name,
                     times_the_bound(report, &eval::CrbRatio::position)});
    cards.push_back({"heading error, RMSE", significant(error.heading_deg.rmse), "deg",
                     times_the_bound(report, &eval::CrbRatio::heading)});
  }
  if (!report.update_times_us.empty()) {
    const double median_us = percentile(report.update_times_us, 0.5);
    const double p99_us = percentile(report.update_times_us, 0.99);
    std::string note = "p99 " + significant(1e-3 * p99_us) + " ms";
    if (counts.scans > 1 && clock.duration_s() > 0.0) {
      const double period_us = 1e6 * clock.duration_s() / static_cast<double>(counts.scans - 1);
      note += ", scans come every " + significant(1e-3 * period_us) + " ms";
    }
    cards.push_back({"time of an update, median", significant(1e-3 * median_us), "ms", note});
  }
  if (!report.estimates.empty())
    cards.push_back(
        {"driven", number(driven_m(report), 1), "m", "in " + number(clock.duration_s(), 1) + " s"});
  return cards;
}

void add_status_table(Page& page, const Counts& counts) {
  Table table{"Status of the scans", {"status", "scans", "share"}, {}};
  for (std::size_t i = 0; i < kStatuses.size(); ++i)
    if (counts.of[i] > 0 || kStatuses[i] != Status::not_started)
      table.rows.push_back({words(kStatuses[i]), grouped(counts.of[i]), percent(counts.of[i], counts.scans)});
  page.table(table);
}

/// What bounds the errors, where anything does.
void add_protection(Page& page, const RunReport& report, const RunClock& clock) {
  const bool is_bounded =
      std::any_of(report.estimates.begin(), report.estimates.end(), [](const PoseEstimate& e) {
        return e.protection_m < PoseEstimate::kUnbounded_m || e.protection_rad < kPi;
      });
  if (!is_bounded) return;
  page.heading("Protection levels");
  page.begin_row();
  page.figure(draw_position_protection(report, clock),
              "The true position is within the level, but for one scan in ten thousand.");
  page.figure(draw_heading_protection(report, clock), "The same of the heading.");
  page.end_row();
}

void add_figures(Page& page, const RunReport& report, const RunClock& clock) {
  page.heading("Map");
  page.figure(draw_run_map(report), "The path in the map frame, one scale for both axes.");
  if (!report.errors.empty()) {
    page.heading("Error against the reference");
    page.begin_row();
    page.figure(draw_position_error(report, clock), "Distance from the reference position at each scan.");
    page.figure(draw_heading_error(report, clock), "Angle to the reference heading at each scan.");
    page.end_row();
  }
  if (!report.estimates.empty()) {
    page.heading("Uncertainty by its own account");
    page.begin_row();
    page.figure(draw_position_sigma(report, clock), "Root of the variances of x and y together.");
    page.figure(draw_heading_sigma(report, clock), "Root of the variance of the heading.");
    page.end_row();
    add_protection(page, report, clock);
    page.heading("Quality and speed");
    page.begin_row();
    page.figure(draw_quality(report, clock),
                "How far the pose deserves trust; a pose that is ok at 0.5 or more does.");
    if (!report.judged.empty())
      page.figure(draw_reliability(report), "How often poses of a quality are where they say to be.");
    if (!report.update_times_us.empty())
      page.figure(draw_update_times(report),
                  "Time of the localizer's update alone, without reading the recording.");
    page.end_row();
  }
}

void add_notes(Page& page, const RunReport& report) {
  if (!report.problems.empty()) {
    page.heading("Notes");
    const std::size_t shown = std::min(report.problems.size(), kMostProblems);
    std::vector<std::string> items(report.problems.begin(),
                                   report.problems.begin() + static_cast<std::ptrdiff_t>(shown));
    if (shown < report.problems.size())
      items.push_back("… and " + grouped(report.problems.size() - shown) + " more");
    page.list(items);
  }
  if (!report.command_line.empty() || !report.config_text.empty()) page.heading("How this was made");
  if (!report.command_line.empty()) page.details("Command", report.command_line, true);
  if (!report.config_text.empty())
    page.details("Configuration: every parameter of the run", report.config_text);
}

std::string subtitle_of(const RunReport& report) {
  std::string text;
  const auto add = [&](const char* what, const std::string& name) {
    if (!name.empty()) text += (text.empty() ? "" : " · ") + std::string(what) + name;
  };
  add("method ", report.method);
  add("map ", report.map_name);
  add("recording ", report.recording_name);
  return text;
}

}  // namespace

std::string html(const RunReport& report) {
  const Counts counts(report);
  const RunClock clock(report);
  Page page(report.title.empty() ? "Localization run" : report.title, subtitle_of(report));
  page.verdict(verdict_of(counts), verdict_words(report, counts));
  page.cards(cards_of(report, counts, clock));
  add_figures(page, report, clock);
  page.heading("Tables");
  if (const Table errors = error_table(report); !errors.rows.empty()) page.table(errors);
  add_status_table(page, counts);
  if (const Table places = places_table(report); !places.rows.empty()) page.table(places);
  add_notes(page, report);
  return page.html();
}

std::string draw_run_svg(const RunReport& report, const MapViewConfig& config) {
  return svg_file(draw_run_map(report, config));
}

}  // namespace beaconless::report
