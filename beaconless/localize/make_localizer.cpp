// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/make_localizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "beaconless/core/suggest.hpp"
#include "beaconless/localize/icp_localizer.hpp"

namespace beaconless {
namespace {

const std::array<Method, 1> kMethods = {
    Method{"icp-full", "every point of the scan against the walls of the map, by re-weighted ICP"},
};

Error unknown_method(const std::string& name) {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const Method& method : kMethods) names.push_back(method.name);
  const std::string near = nearest_word(name, names);
  return {"method", "there is no method \"" + name + "\"",
          near.empty() ? "`beaconless params` lists what there is" : "did you mean \"" + near + "\"?"};
}

Result<std::unique_ptr<Localizer>> make_icp_full(const LocalizerConfig& config, const FloorPlan& plan) {
  WallIndex walls(plan, config.icp.max_pair_distance_m);
  if (walls.wall_count() == 0)
    return Error{"map", "the floor plan has no walls", "a wall is two points or more"};
  return std::unique_ptr<Localizer>(std::make_unique<IcpLocalizer<WallIndex>>(config, std::move(walls)));
}

Result<std::unique_ptr<Localizer>> make_icp_full(LocalizerConfig config, const OccupancyGrid& grid) {
  // A wall drawn into cells is off by up to half a cell.
  if (config.icp.map_sigma_m == 0.0) config.icp.map_sigma_m = grid.resolution_m / std::sqrt(12.0);
  const bool chosen = config.icp.on_map_m != IcpConfig{}.on_map_m;
  if (!chosen) config.icp.on_map_m = std::max(config.icp.on_map_m, 2.0 * grid.resolution_m);
  CellIndex cells(grid, config.icp.max_pair_distance_m);
  if (cells.surface_count() == 0)
    return Error{"map", "the grid has no occupied cell",
                 "check occupied_thresh and negate of the map's YAML"};
  return std::unique_ptr<Localizer>(std::make_unique<IcpLocalizer<CellIndex>>(config, std::move(cells)));
}

}  // namespace

void describe(Fields& fields, LocalizerConfig& config) {
  Words names;
  names.reserve(kMethods.size());
  for (const Method& method : kMethods) names.push_back(method.name);
  fields("method", config.method, names, "how a pose is found");
  fields("base_from_laser.x_m", config.base_from_laser.x_m, {-100.0, 100.0},
         "the laser's place ahead of the base");
  fields("base_from_laser.y_m", config.base_from_laser.y_m, {-100.0, 100.0}, "the laser's place to the left");
  fields("base_from_laser.theta_rad", config.base_from_laser.theta_rad, {-7.0, 7.0}, "the laser's heading");
  fields.section("icp", config.icp);
  fields.section("search", config.search);
  fields.section("motion", config.motion);
  fields.section("health", config.health);
}

std::span<const Method> methods() { return kMethods; }

Result<std::unique_ptr<Localizer>> make_localizer(const LocalizerConfig& config, const Map& map) {
  const bool known =
      std::any_of(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.name == config.method; });
  if (!known) return unknown_method(config.method);
  if (auto checked = check_config(config); !checked) return checked.error();
  return std::visit([&](const auto& kind) { return make_icp_full(config, kind); }, map);
}

}  // namespace beaconless
