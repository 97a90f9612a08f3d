// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "beaconless/eval/crb.hpp"
#include "beaconless/eval/errors.hpp"
#include "beaconless/eval/trust.hpp"
#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/report/candidate_places.hpp"
#include "beaconless/report/map_view.hpp"

namespace beaconless::report {

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
  std::vector<PlacedScan> good_scans;   ///< at poses that are ok: what they say against the map is shown
  std::vector<CandidatePlaces> places;  ///< where the robot may have been, while that was not clear
  std::vector<double> update_times_us;  ///< of `update()` alone, one a scan

  std::vector<eval::PoseError> errors;                 ///< against the reference
  std::vector<std::optional<Eigen::Matrix3d>> bounds;  ///< Cramér–Rao: one for each error, or empty
  std::optional<eval::ErrorTable> error;               ///< as it is
  std::optional<eval::ErrorTable> error_aligned;       ///< after rigid alignment
  std::optional<eval::CrbRatio> bound_ratio;           ///< RMSE over bound
  std::vector<eval::JudgedEstimate> judged;  ///< what estimates said of themselves, and their errors

  std::string config_text;
  std::vector<std::string> problems;  ///< what readers and localizer complained about, one line each
};

/// The page of a run: the verdict in words, key figures, map, errors, uncertainty, trust, times, tables,
/// settings.
///
/// Out: one self-contained HTML file, the same bytes for the same run. Well below 5 MB for 100 000 scans.
/// Cost: O(scans + map cells).
std::string html(const RunReport& report);

/// The map of the run alone, as an SVG file.
std::string draw_run_svg(const RunReport& report, const MapViewConfig& config = {});

}  // namespace beaconless::report
