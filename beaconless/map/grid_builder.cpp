// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/grid_builder.hpp"

namespace beaconless {
namespace {

constexpr double kMaxCoordinate_m = 1e6;

}  // namespace

void describe(Fields& fields, GridBuilderConfig& config) {
  fields("resolution_m", config.resolution_m, {0.001, 10.0}, "side of a cell");
  fields("p_occupied", config.p_occupied, {0.51, 0.999},
         "probability that a cell is occupied where a beam ended");
  fields("p_free", config.p_free, {0.001, 0.49},
         "probability that a cell is occupied where a beam went through");
  fields("min_log_odds", config.min_log_odds, {-31.0, -0.1}, "how sure a cell can be of being free");
  fields("max_log_odds", config.max_log_odds, {0.1, 31.0}, "how sure a cell can be of being occupied");
  fields("max_range_m", config.max_range_m, {0.1, 1000.0}, "hits beyond it only free the way up to it");
  fields("no_return_free_m", config.no_return_free_m, {0.0, 1000.0},
         "beams without return free the way up to here; 0: they say nothing");
}

Result<GridBuilder> GridBuilder::make(const GridBuilderConfig& config) {
  if (const auto checked = check_config(config); !checked) return checked.error();
  return GridBuilder(config, {config.p_occupied, config.p_free, config.min_log_odds, config.max_log_odds});
}

Result<Done> GridBuilder::add(const Scan& scan, const Pose2& map_from_laser) {
  if (!map_from_laser.is_finite() || map_from_laser.translation().cwiseAbs().maxCoeff() > kMaxCoordinate_m)
    return Error{"map_from_laser", "the pose is not finite or beyond 1e6 m",
                 "check the poses that go with the scans"};
  beam_ways(scan, map_from_laser, {config_.max_range_m, config_.no_return_free_m}, ways_);
  return cells_.add(map_from_laser.translation(), ways_);
}

}  // namespace beaconless
