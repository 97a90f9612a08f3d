// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/report/run_figures.hpp"

namespace beaconless::report {
namespace {

constexpr double kMinutesFrom_s = 600.0;
constexpr double kHoursFrom_s = 3.0 * 3600.0;

int severity(Status status) {
  switch (status) {
    case Status::ok:
    case Status::not_a_scan:
      return 0;
    case Status::not_started:
      return 1;
    case Status::degraded:
      return 2;
    case Status::relocalizing:
      return 3;
    case Status::lost:
      return 4;
  }
  return 4;
}

}  // namespace

RunClock::RunClock(const RunReport& report) {
  // Doubles, not differences of nanoseconds: stamps from a broken file may be further apart than 64 bits
  // count.
  bool any = false;
  double end_s = 0.0;
  const auto include = [&](Stamp stamp) {
    start_s_ = any ? std::min(start_s_, stamp.seconds()) : stamp.seconds();
    end_s = any ? std::max(end_s, stamp.seconds()) : stamp.seconds();
    any = true;
  };
  for (const PoseEstimate& estimate : report.estimates) include(estimate.stamp);
  if (!any)
    for (const eval::PoseError& error : report.errors) include(error.stamp);
  duration_s_ = end_s - start_s_;
  if (duration_s_ >= kHoursFrom_s) {
    unit_s_ = 3600.0;
    unit_ = "h";
  } else if (duration_s_ >= kMinutesFrom_s) {
    unit_s_ = 60.0;
    unit_ = "min";
  }
}

double RunClock::operator()(Stamp stamp) const { return (stamp.seconds() - start_s_) / unit_s_; }

LengthUnit LengthUnit::for_size(double typical_m) {
  return typical_m < 0.1 ? LengthUnit{"mm", 1000.0} : LengthUnit{"m", 1.0};
}

LengthUnit LengthUnit::for_axis(std::span<const double> values_m) {
  const double most_m = percentile(values_m, 1.0);
  return std::isnan(most_m) ? LengthUnit{} : for_size(0.2 * most_m);
}

std::string words(Status status) {
  std::string text(to_string(status));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

double percentile(std::span<const double> values, double share) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  if (finite.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(finite.size()));
  const auto nth = finite.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(finite.begin(), nth, finite.end());
  return *nth;
}

std::vector<Shade> status_shades(const RunReport& report, const RunClock& clock, std::size_t columns) {
  if (report.estimates.empty() || columns == 0) return {};
  double end = 0.0;
  for (const PoseEstimate& estimate : report.estimates) end = std::max(end, clock(estimate.stamp));
  const double width = end > 0.0 ? end / static_cast<double>(columns) : 1.0;
  std::vector<Status> worst(columns, Status::ok);
  const auto column_of = [&](Stamp stamp) {
    return std::min(columns - 1, static_cast<std::size_t>(clock(stamp) / width));
  };
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    const PoseEstimate& estimate = report.estimates[i];
    // A status holds until the next scan says something else.
    const std::size_t from = column_of(estimate.stamp);
    const std::size_t next =
        i + 1 < report.estimates.size() ? column_of(report.estimates[i + 1].stamp) : from + 1;
    for (std::size_t c = from; c < std::max(next, from + 1) && c < columns; ++c)
      if (severity(estimate.status) > severity(worst[c])) worst[c] = estimate.status;
  }
  std::vector<Shade> shades;
  for (std::size_t c = 0; c < columns;) {
    std::size_t last = c;
    while (last < columns && worst[last] == worst[c]) ++last;
    if (severity(worst[c]) > 0)
      shades.push_back({static_cast<double>(c) * width, static_cast<double>(last) * width, words(worst[c]),
                        colour_of(worst[c])});
    c = last;
  }
  return shades;
}

}  // namespace beaconless::report
