// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/make_localizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "beaconless/core/suggest.hpp"
#include "beaconless/localize/amcl_localizer.hpp"
#include "beaconless/localize/feature_matcher.hpp"
#include "beaconless/localize/multi_laser_localizer.hpp"
#include "beaconless/localize/points_matcher.hpp"
#include "beaconless/localize/tracking_localizer.hpp"
#include "beaconless/localize/walls_matcher.hpp"
#include "beaconless/match/grid_outlines.hpp"

namespace beaconless {
namespace {

constexpr int kThinWall_cells = 4;     // a wall of a grid that has more of them has two sides
constexpr double kPlanSigma_m = 0.03;  // by how much walls that were measured may be off
constexpr int kLeastPoints = 8;        // of the crosses of two keypoints
constexpr double kDrawnArm_m = 0.4;    // longer than those of a scan, which may be off by the difference

/// What the scan is fitted by.
enum class Fitting { icp, feature_icp, hector, walls, amcl };

/// A method: what is taken from a scan, and how that is fitted to the map.
struct Recipe {
  Fitting fitting = Fitting::icp;
  PointsFrom points = PointsFrom::whole_scan;  // of icp and hector
  Detector detector = Detector::falko;         // of all but whole scans
  bool is_tracked = false;                     // of feature_icp
  bool is_polished = false;                    // of amcl, by walls
};

struct NamedRecipe {
  Method method;
  Recipe recipe;
};

const std::array<NamedRecipe, 16>& recipes() {
  static const std::array<NamedRecipe, 16> kAll{{
      {{"walls", "every beam against the wall that it hits, by maximum likelihood"}, {Fitting::walls}},
      {{"icp-full", "every point of the scan against the walls of the map, by re-weighted ICP"},
       {Fitting::icp}},
      {{"icp-rdp", "vertices that Douglas and Peucker keep, as corners, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::rdp}},
      {{"icp-corners", "corners where fitted lines cross, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::corners}},
      {{"icp-corners-ft", "the same, and corners are remembered for a few scans after they vanish"},
       {Fitting::feature_icp, {}, Detector::corners, true}},
      {{"icp-oc", "keypoints of OC, by re-weighted ICP"}, {Fitting::feature_icp, {}, Detector::oc}},
      {{"icp-falko", "keypoints of FALKO, by re-weighted ICP"}, {Fitting::feature_icp, {}, Detector::falko}},
      {{"icp-flirt-blob", "keypoints of FLIRT's normal blobs, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::flirt_blob}},
      {{"icp-flirt-edge", "keypoints of FLIRT's normal edges, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::flirt_edge}},
      {{"icp-flirt-range", "keypoints of FLIRT's ranges, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::flirt_range}},
      {{"icp-flirt-curvature", "keypoints of FLIRT's curvature, by re-weighted ICP"},
       {Fitting::feature_icp, {}, Detector::flirt_curvature}},
      {{"hector-full", "every point of the scan on a pyramid of grids, as HectorSLAM matches"},
       {Fitting::hector}},
      {{"hector-keypoints", "keypoints of FALKO on the pyramid"}, {Fitting::hector, PointsFrom::keypoints}},
      {{"hector-regions", "the points around keypoints of FALKO on the pyramid"},
       {Fitting::hector, PointsFrom::regions}},
      {{"amcl", "a cloud of poses that moves with the robot and is thinned out by scans, as ROS's amcl"},
       {Fitting::amcl}},
      {{"amcl+walls", "the same, and every beam against the wall that it hits polishes each pose"},
       {.fitting = Fitting::amcl, .is_polished = true}},
  }};
  return kAll;
}

Error unknown_method(const std::string& name) {
  std::vector<std::string> names;
  names.reserve(methods().size());
  for (const Method& method : methods()) names.push_back(method.name);
  const std::string near = nearest_word(name, names);
  return {"method", "there is no method \"" + name + "\"",
          near.empty() ? "`beaconless methods` lists what there is" : "did you mean \"" + near + "\"?"};
}

/// What a map's kind settles where the user has not.
LocalizerConfig for_map(LocalizerConfig config, const Map& map) {
  const auto* grid = std::get_if<OccupancyGrid>(&map);
  const bool is_sigma_chosen = config.places.sigma_m != PlacesConfig{}.sigma_m;
  if (grid == nullptr) {
    if (!is_sigma_chosen) config.places.sigma_m = kPlanSigma_m;
    return config;
  }
  // A wall drawn into cells is off by up to half a cell.
  if (config.icp.map_sigma_m == 0.0) config.icp.map_sigma_m = grid->resolution_m / std::sqrt(12.0);
  config.places.sigma_m = std::max(config.places.sigma_m, grid->resolution_m);
  const bool is_chosen = config.icp.on_map_m != IcpConfig{}.on_map_m;
  if (!is_chosen) config.icp.on_map_m = std::max(config.icp.on_map_m, 2.0 * grid->resolution_m);
  if (config.hector.on_map_m == HectorConfig{}.on_map_m) config.hector.on_map_m = config.icp.on_map_m;
  if (config.walls.on_map_m == WallsConfig{}.on_map_m) config.walls.on_map_m = config.icp.on_map_m;
  return config;
}

using Made = Result<std::unique_ptr<ScanMatcher>>;

Made make_icp(const Recipe& recipe, const LocalizerConfig& config,
              const std::shared_ptr<const SurfaceMap>& surfaces) {
  ScanPoints points(recipe.points, recipe.detector, config.features.detectors, config.regions);
  auto fit = [surfaces, icp = config.icp, scratch = IcpScratch{}](std::span<const Eigen::Vector2d> seen,
                                                                  const Pose2& guess) mutable {
    return match_icp(seen, *surfaces, guess, icp, scratch);
  };
  return {std::unique_ptr<ScanMatcher>(std::make_unique<PointsMatcher>(std::move(points), std::move(fit)))};
}

Made make_feature_icp(const Recipe& recipe, const LocalizerConfig& config, const Map& map) {
  auto features = build_feature_map(map, recipe.detector, config.features, config.feature_map);
  if (!features) return features.error();
  FeatureMatcherConfig matching{
      .detector = recipe.detector, .detecting = config.features, .icp = config.feature_icp};
  if (recipe.is_tracked) matching.tracking = config.tracking;
  return {std::unique_ptr<ScanMatcher>(std::make_unique<FeatureMatcher>(matching, *std::move(features)))};
}

/// The features of a map, each drawn as a cross: on walls a keypoint could slide along.
Result<Map> crosses_of(Detector detector, const LocalizerConfig& config, const Map& map) {
  const auto features = build_feature_map(map, detector, config.features, config.feature_map);
  if (!features) return features.error();
  FloorPlan crosses;
  crosses.walls.reserve(2 * features->features.size());
  for (const PointFeature& feature : features->features) {
    for (const Eigen::Vector2d& arm : cross_arms(feature.orientation_rad, kDrawnArm_m))
      crosses.walls.push_back({feature.point - arm, feature.point + arm});
  }
  return Map(std::move(crosses));
}

Made make_hector(const Recipe& recipe, const LocalizerConfig& config, const Map& whole_map) {
  const bool is_of_keypoints = recipe.points == PointsFrom::keypoints;
  const auto map = is_of_keypoints ? crosses_of(recipe.detector, config, whole_map) : Result<Map>(whole_map);
  if (!map) return map.error();
  auto pyramid = std::visit([&](const auto& kind) { return build_pyramid(kind, config.pyramid); }, *map);
  if (!pyramid) return pyramid.error();
  // Features of a map are off by what its walls are off.
  if (is_of_keypoints)
    pyramid.value().wall_sigma_m = std::max(pyramid.value().wall_sigma_m, config.icp.map_sigma_m);
  HectorConfig hector = config.hector;
  if (is_of_keypoints) hector.min_pairs = std::min(hector.min_pairs, kLeastPoints);
  ScanPoints points(recipe.points, recipe.detector, config.features.detectors, config.regions);
  auto fit = [levels = *std::move(pyramid), hector, scratch = HectorScratch{}](
                 std::span<const Eigen::Vector2d> seen, const Pose2& guess) mutable {
    return match_hector(seen, levels, guess, hector, scratch);
  };
  return {std::unique_ptr<ScanMatcher>(std::make_unique<PointsMatcher>(std::move(points), std::move(fit)))};
}

/// The walls of a map: those of a plan, or those that can be read from a grid.
Map as_walls(const Map& map) {
  const auto* grid = std::get_if<OccupancyGrid>(&map);
  if (grid == nullptr) return map;
  FloorPlan plan = outlines_of(*grid, {.thin_cells = kThinWall_cells});
  return plan.walls.empty() ? map : Map(std::move(plan));
}

Made make_walls(const LocalizerConfig& config, const std::shared_ptr<const SurfaceMap>& surfaces) {
  return {std::unique_ptr<ScanMatcher>(std::make_unique<WallsMatcher>(
      std::shared_ptr<const WallIndex>(surfaces, &std::get<WallIndex>(*surfaces)), config.walls,
      config.icp))};
}

Made make_matcher(const Recipe& recipe, const LocalizerConfig& config, const Map& map,
                  const std::shared_ptr<const SurfaceMap>& surfaces) {
  switch (recipe.fitting) {
    case Fitting::feature_icp:
      return make_feature_icp(recipe, config, map);
    case Fitting::hector:
      return make_hector(recipe, config, map);
    case Fitting::walls:
      return make_walls(config, surfaces);
    case Fitting::amcl:
    case Fitting::icp:
      break;
  }
  return make_icp(recipe, config, surfaces);
}

using MadeLocalizer = Result<std::unique_ptr<Localizer>>;

using Surfaces = std::shared_ptr<const SurfaceMap>;

/// What a method needs of the map that several localizers can share.
Result<Surfaces> make_surfaces(const Recipe& recipe, const LocalizerConfig& config, const Map& map) {
  const double reach_m = recipe.fitting == Fitting::amcl ? config.amcl.laser_likelihood_max_dist
                                                         : config.icp.max_pair_distance_m;
  auto built = build_surface_map(recipe.fitting == Fitting::walls ? as_walls(map) : map, reach_m);
  if (!built) return built.error();
  return std::make_shared<const SurfaceMap>(*std::move(built));
}

MadeLocalizer make_tracking(const Recipe& recipe, const LocalizerConfig& config, const Map& map,
                            const Surfaces& surfaces) {
  auto matcher = make_matcher(recipe, config, map, surfaces);
  if (!matcher) return matcher.error();
  return {
      std::unique_ptr<Localizer>(std::make_unique<TrackingLocalizer>(config, surfaces, *std::move(matcher)))};
}

MadeLocalizer make_amcl(const Recipe& recipe, const LocalizerConfig& config, const Map& map,
                        const Surfaces& surfaces) {
  std::unique_ptr<ScanMatcher> polish;
  const Map walls = recipe.is_polished ? as_walls(map) : Map{};
  // A grid that no walls can be read from is left to the cloud.
  if (recipe.is_polished && std::holds_alternative<FloorPlan>(walls)) {
    auto walls_built = build_surface_map(walls, config.icp.max_pair_distance_m);
    if (!walls_built) return walls_built.error();
    auto made = make_walls(config, std::make_shared<const SurfaceMap>(*std::move(walls_built)));
    if (!made) return made.error();
    polish = *std::move(made);
  }
  return {
      std::unique_ptr<Localizer>(std::make_unique<AmclLocalizer>(config, map, surfaces, std::move(polish)))};
}

MadeLocalizer make_one(const Recipe& recipe, const LocalizerConfig& config, const Map& map,
                       const Surfaces& surfaces) {
  return recipe.fitting == Fitting::amcl ? make_amcl(recipe, config, map, surfaces)
                                         : make_tracking(recipe, config, map, surfaces);
}

/// One a laser, on the same surfaces.
MadeLocalizer make_several(const Recipe& recipe, const LocalizerConfig& config, const Map& map,
                           const Surfaces& surfaces) {
  std::vector<MultiLaserLocalizer::Laser> lasers;
  for (const LaserOnRobot& laser : config.lasers) {
    LocalizerConfig of_one = config;
    of_one.lasers.clear();
    of_one.base_from_laser = laser.base_from_laser;
    auto made = make_one(recipe, of_one, map, surfaces);
    if (!made) return made.error();
    lasers.push_back({laser.frame_id, *std::move(made)});
  }
  return {std::unique_ptr<Localizer>(std::make_unique<MultiLaserLocalizer>(config, std::move(lasers)))};
}

Result<Done> check_lasers(const std::vector<LaserOnRobot>& lasers) {
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const auto& [frame_id, place] = lasers[i];
    if (!place.is_finite())
      return Error{"lasers", "the place of \"" + frame_id + "\" is not finite", "tell metres and radians"};
    for (std::size_t k = 0; k < i; ++k)
      if (lasers[k].frame_id == frame_id)
        return Error{"lasers", "two have the frame \"" + frame_id + "\", so their scans cannot be told apart",
                     "give each driver a frame of its own"};
  }
  return Done{};
}

}  // namespace

std::span<const Method> methods() {
  static const std::vector<Method> kAll = [] {
    std::vector<Method> list;
    list.reserve(recipes().size());
    for (const NamedRecipe& of : recipes()) list.push_back(of.method);
    return list;
  }();
  return kAll;
}

Result<std::unique_ptr<Localizer>> make_localizer(const LocalizerConfig& config, const Map& map) {
  const auto* const named = std::find_if(recipes().begin(), recipes().end(), [&](const NamedRecipe& of) {
    return of.method.name == config.method;
  });
  if (named == recipes().end()) return unknown_method(config.method);
  if (auto checked = check_config(config); !checked) return checked.error();
  if (auto lasers = check_lasers(config.lasers); !lasers) return lasers.error();
  LocalizerConfig settled = for_map(config, map);
  const auto surfaces = make_surfaces(named->recipe, settled, map);
  if (!surfaces) return surfaces.error();
  return settled.lasers.empty() ? make_one(named->recipe, settled, map, *surfaces)
                                : make_several(named->recipe, settled, map, *surfaces);
}

}  // namespace beaconless
