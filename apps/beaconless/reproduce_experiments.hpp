// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/eval/errors.hpp"
#include "beaconless/pose_estimate.hpp"

#include "reproduce_scenes.hpp"

namespace beaconless::cli {

/// What is constant in many errors, and what scatters about it.
///
/// Source: the dissertation's full-scan ICP has a mean of 21.4 mm and an SD of 0.6 mm: its error is one
/// vector, and says where map and reference lay. Mean and SD of distances, as it printed them, do not tell
/// the two apart when the errors point in all directions.
struct Offset {
  double x_m = 0.0;  ///< mean error along the room's axes
  double y_m = 0.0;
  double along_m = 0.0;  ///< and along the robot's
  double across_m = 0.0;
  double heading_deg = 0.0;
  double scatter_m = 0.0;  ///< root mean square of what is left, x and y together
  double scatter_deg = 0.0;

  double norm_m() const;
};

Offset offset_of(std::span<const eval::PoseError> errors);

/// One method in one scenario on one map.
struct Experiment {
  std::string scenario;
  MapKind map = MapKind::exact;
  std::string method;
  std::string refused;  ///< why the method does not run on this map; then the rest is empty
  std::vector<PoseEstimate> estimates;
  std::vector<eval::PoseError> errors;  ///< one an estimate, whatever its status
  eval::ErrorTable table;
  Offset offset;
  std::size_t ok_count = 0;
  std::size_t degraded_count = 0;
  std::size_t lost_count = 0;
  double max_ok_m = 0.0;   ///< the largest error of an estimate that said ok
  double closure_m = 0.0;  ///< from the first estimate to the last
  double median_us = 0.0;  ///< of update(); all that is not the same twice
  double p99_us = 0.0;
};

/// The methods to run, those of the dissertation first and in its order; `left_out` are those of the
/// dissertation that are not among them.
struct MethodList {
  std::vector<std::string> present;
  std::vector<std::string> left_out;
};

/// All that this program knows, or those of them that are asked for. Errors: one that it does not know.
Result<MethodList> reproduced_methods(std::span<const std::string> asked_for = {});

/// Every method in every scene on every map: by scene, then map, then method. A localizer is made once for
/// all scenes of a plan and starts anew in each.
std::vector<Experiment> run_experiments(const Console& console, std::span<const Scene> scenes,
                                        std::span<const std::string> methods);

/// The experiment, where it was made and not refused.
const Experiment* find(std::span<const Experiment> experiments, std::string_view scenario, MapKind map,
                       std::string_view method);

}  // namespace beaconless::cli
