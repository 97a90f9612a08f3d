// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "beaconless/map/plan_corners.hpp"

namespace beaconless {
namespace {

constexpr double kLeastSigma_m = 1e-3;
constexpr double kBucket_m = 1.0;

bool is_of_walls(Detector detector) { return detector == Detector::corners || detector == Detector::rdp; }

/// Those corners of a plan that the detector would not refuse for their angle or their walls.
FeatureMap read_off(const FloorPlan& plan, Detector detector, const DetectorsConfig& detecting) {
  const bool vertices = detector == Detector::rdp;
  const double min_arm_m = vertices ? detecting.rdp.min_arm_m : detecting.corners.min_arm_m;
  const double min_angle_deg = vertices ? detecting.rdp.min_angle_deg : detecting.corners.min_angle_deg;
  FeatureMap map;
  for (const PlanCorner& corner : find_plan_corners(plan, {.min_angle_deg = std::min(89.0, min_angle_deg)}))
    if (corner.arm_m >= min_arm_m)
      map.features.push_back(
          {corner.point, Eigen::Matrix2d::Zero(), corner.orientation_rad, corner.opening_rad});
  map.evidence.resize(map.features.size());
  return map;
}

/// What a detector finds from all over the free space.
Result<FeatureMap> look_around(const RayCaster& walls, const OccupancyGrid* grid, Detector detector,
                               const PointFeaturesConfig& detecting, const FeatureMapConfig& config) {
  const std::vector<Pose2> views = choose_map_views(walls, grid, config.views);
  if (views.empty())
    return Error{"map", "there is no place in it that walls surround",
                 "a smaller views.clearance_m may help; a grid needs free cells"};
  std::vector<MapFind> finds;
  std::vector<PointFeature> found;
  PointFeaturesScratch scratch;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Scan scan = look_at_map(walls, views[i], config.views);
    find_point_features(scan, detector, detecting, scratch, found);
    for (PointFeature& feature : found) {
      const double range_m = feature.point.norm();
      feature.point = views[i] * feature.point;
      feature.orientation_rad = wrap_angle(feature.orientation_rad + views[i].theta_rad);
      if (feature.point.allFinite()) finds.push_back({feature, static_cast<int>(i), range_m});
    }
  }
  FeatureMap map;
  for (const RepeatedFind& repeated : gather_repeated_finds(finds, views, walls, config.finds)) {
    map.features.push_back(repeated.feature);
    map.evidence.push_back(repeated.evidence);
  }
  return map;
}

Error no_walls(const Map& map) {
  return std::holds_alternative<FloorPlan>(map)
             ? Error{"map", "the floor plan has no walls", "a wall is two points or more"}
             : Error{"map", "the grid has no occupied cell",
                     "check occupied_thresh and negate of the map's YAML"};
}

}  // namespace

void describe(Fields& fields, FeatureMapConfig& config) {
  fields("map_sigma_m", config.map_sigma_m, {0.0, 1.0},
         "standard deviation of the map's walls; 0: none for a floor plan, that of its cells for a grid");
  fields.section("views", config.views);
  fields.section("finds", config.finds);
  fields.section("outlines", config.outlines);
}

Result<FeatureMap> build_feature_map(const Map& map, Detector detector, const PointFeaturesConfig& detecting,
                                     const FeatureMapConfig& config) {
  if (auto checked = check_config(config); !checked) return checked.error();
  if (auto checked = check_config(detecting); !checked) return checked.error();
  // 1. The walls as lines.
  const auto* grid = std::get_if<OccupancyGrid>(&map);
  const FloorPlan plan = grid != nullptr ? outlines_of(*grid, config.outlines) : std::get<FloorPlan>(map);
  std::vector<Segment2> walls = plan.segments();
  if (walls.empty()) return no_walls(map);

  // 2. Corners that are drawn need no looking for.
  FeatureMap built;
  if (grid == nullptr && is_of_walls(detector)) {
    built = read_off(plan, detector, detecting.detectors);
  } else {
    auto seen = look_around(RayCaster(std::move(walls)), grid, detector, detecting, config);
    if (!seen) return seen.error();
    built = std::move(seen).value();
  }
  if (built.features.empty())
    return Error{"map",
                 "it has no features that the detector \"" + std::string(to_string(detector)) + "\" finds",
                 "use a method that needs none, as icp-full, or another detector"};

  // 3. What is not known of their places.
  const double of_cells_m = grid != nullptr ? grid->resolution_m / std::sqrt(12.0) : 0.0;
  const double sigma_m = std::max(config.map_sigma_m > 0.0 ? config.map_sigma_m : of_cells_m, kLeastSigma_m);
  std::vector<Eigen::Vector2d> points;
  points.reserve(built.features.size());
  for (PointFeature& feature : built.features) {
    feature.covariance += sigma_m * sigma_m * Eigen::Matrix2d::Identity();
    points.push_back(feature.point);
  }
  built.places = PointBuckets(points, kBucket_m);
  return built;
}

}  // namespace beaconless
