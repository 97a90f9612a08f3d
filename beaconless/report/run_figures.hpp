// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "beaconless/report/plot.hpp"
#include "beaconless/report/run_report.hpp"

/// The figures of a run's page.
namespace beaconless::report {

/// Time since the first estimate, in the unit that suits the length of the run.
class RunClock {
 public:
  explicit RunClock(const RunReport& report);

  double operator()(Stamp stamp) const;
  std::string title() const { return "time [" + unit_ + "]"; }
  const std::string& unit() const { return unit_; }  ///< s, min or h
  double duration_s() const { return duration_s_; }

 private:
  double start_s_ = 0.0;
  double duration_s_ = 0.0;
  double unit_s_ = 1.0;
  std::string unit_ = "s";
};

/// A length in metres shown in a unit that needs few digits.
struct LengthUnit {
  std::string name = "m";
  double per_m = 1.0;

  /// Millimetres below 0.1 m, else metres.
  static LengthUnit for_size(double typical_m);
  /// The one for an axis that reaches to the largest of `values_m`.
  static LengthUnit for_axis(std::span<const double> values_m);
};

/// The value below which `share` of the finite ones lie (nearest rank); NaN when there is none.
double percentile(std::span<const double> values, double share);

/// The status as a reader's word: "not started".
std::string words(Status status);

/// Where the status was not ok, at most `columns` stretches; in each column of time the worst status counts.
std::vector<Shade> status_shades(const RunReport& report, const RunClock& clock, std::size_t columns = 600);

Picture draw_run_map(const RunReport& report, const MapViewConfig& config = {});
Picture draw_position_error(const RunReport& report, const RunClock& clock);
Picture draw_heading_error(const RunReport& report, const RunClock& clock);
Picture draw_position_sigma(const RunReport& report, const RunClock& clock);
Picture draw_heading_sigma(const RunReport& report, const RunClock& clock);
Picture draw_quality(const RunReport& report, const RunClock& clock);
Picture draw_update_times(const RunReport& report);

/// The protection levels of the estimates, above the errors where there is a reference.
Picture draw_position_protection(const RunReport& report, const RunClock& clock);
Picture draw_heading_protection(const RunReport& report, const RunClock& clock);

/// How often poses of a quality are near the reference, against that quality.
Picture draw_reliability(const RunReport& report);

/// What is marked in the map besides the path: candidate places, and beams that contradict the map.
std::vector<MapMarks> marks_of(const RunReport& report);

}  // namespace beaconless::report
