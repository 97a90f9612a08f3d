// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/report/map_view.hpp"

namespace beaconless::report {

/// How far a scan's estimate is from the reference; or, as a bound, how far one sigma of the best estimator
/// would be.
struct PoseError {
  Stamp stamp;
  double position_m = 0.0;
  double heading_deg = 0.0;  ///< absolute
};

/// One row of an error table.
struct ErrorRow {
  double mean = 0.0;
  double rmse = 0.0;
  double sd = 0.0;
  double max = 0.0;
  double min = 0.0;
  double median = 0.0;
  double p95 = 0.0;
};

struct ErrorTable {
  ErrorRow position_m;
  ErrorRow heading_deg;
};

/// Everything that is told about a run. What is empty is left out of the page.
struct RunReport {
  std::string title;
  std::string method;
  std::string map_name;
  std::string recording_name;
  std::string command_line;

  std::shared_ptr<const Map> map;
  std::vector<PoseEstimate> estimates;  ///< one a scan, in the order of the recording
  std::optional<Trajectory> reference;
  std::vector<PlacedScan> scans;        ///< to lay over the map; a dozen is plenty
  std::vector<double> update_times_us;  ///< of `update()` alone, one a scan

  std::vector<PoseError> errors;               ///< against the reference
  std::vector<PoseError> bounds;               ///< the Cramér–Rao bound of the same or other scans
  std::optional<ErrorTable> error;             ///< as it is
  std::optional<ErrorTable> error_aligned;     ///< after rigid alignment
  std::optional<double> position_bound_ratio;  ///< RMSE over bound
  std::optional<double> heading_bound_ratio;

  std::string config_text;
  std::vector<std::string> problems;  ///< what readers and localizer complained about, one line each
};

/// The page of a run: the verdict in words, key figures, map, errors, uncertainty, quality, times, tables,
/// settings.
///
/// Out: one self-contained HTML file, the same bytes for the same run. Well below 5 MB for 100 000 scans.
/// Cost: O(scans + map cells).
std::string html(const RunReport& report);

/// The map of the run alone, as an SVG file.
std::string draw_run_svg(const RunReport& report, const MapViewConfig& config = {});

}  // namespace beaconless::report
