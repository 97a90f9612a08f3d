// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "beaconless/eval/crb.hpp"
#include "beaconless/eval/evaluate.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless::cli {

/// The errors of a run, with the bound they can be compared with where a floor plan and a sigma are known.
struct Judgement {
  eval::Evaluation evaluation;
  std::vector<std::optional<Eigen::Matrix3d>> bounds;  ///< one for each error, or empty
  std::optional<eval::CrbRatio> crb_ratio;
};

/// Compares a trajectory with its reference, and with the Cramér–Rao bound when `map` is a floor plan.
Judgement judge(const Trajectory& estimate, const Trajectory& reference, const Map* map,
                const eval::RangeSensor& sensor, const Pose2& base_from_laser, double max_gap_s = 1.0);

/// {"mean", "rmse", "sd", "max", "min", "median", "p95"}
nlohmann::json to_json(const eval::Statistics& statistics);

/// {"pairs", "position_m", "heading_deg", "aligned", "crb_ratio", "unmatched"}
nlohmann::json to_json(const Judgement& judgement);

/// The dissertation's table: one row for the position, one for the heading.
std::string table_text(const eval::ErrorTable& table, std::string_view first = "position [m]",
                       std::string_view second = "heading [deg]");

}  // namespace beaconless::cli
