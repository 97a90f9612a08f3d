// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_map.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/plan_corners.hpp"
#include "beaconless/match/drawn_corners.hpp"

namespace beaconless {
namespace {

constexpr double kLeastSigma_m = 1e-3;
constexpr double kBucket_m = 1.0;

bool is_of_walls(Detector detector) { return detector == Detector::corners || detector == Detector::rdp; }

/// Those corners of a plan that the detector would not refuse for their angle or their walls.
std::vector<PlanCorner> drawn_corners(const FloorPlan& plan, Detector detector,
                                      const DetectorsConfig& detecting) {
  const bool vertices = detector == Detector::rdp;
  const double min_arm_m = vertices ? detecting.rdp.min_arm_m : detecting.corners.min_arm_m;
  const double min_angle_deg = vertices ? detecting.rdp.min_angle_deg : detecting.corners.min_angle_deg;
  std::vector<PlanCorner> corners = find_plan_corners(plan, {.min_angle_deg = std::min(89.0, min_angle_deg)});
  std::erase_if(corners, [&](const PlanCorner& corner) { return corner.arm_m < min_arm_m; });
  return corners;
}

/// What a detector finds in sweeps from all views, in the map frame.
std::vector<MapFind> look_around(const RayCaster& walls, std::span<const Pose2> views, Detector detector,
                                 const PointFeaturesConfig& detecting, const MapViewsConfig& config) {
  std::vector<MapFind> finds;
  std::vector<PointFeature> found;
  PointFeaturesScratch scratch;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Scan scan = look_at_map(walls, views[i], config);
    find_point_features(scan, detector, detecting, scratch, found);
    for (PointFeature& feature : found) {
      const double range_m = feature.point.norm();
      feature.point = views[i] * feature.point;
      feature.orientation_rad = wrap_angle(feature.orientation_rad + views[i].theta_rad);
      if (feature.point.allFinite()) finds.push_back({feature, static_cast<int>(i), range_m});
    }
  }
  return finds;
}

Error no_walls(const Map& map) {
  return std::holds_alternative<FloorPlan>(map)
             ? Error{"map", "the floor plan has no walls", "a wall is two points or more"}
             : Error{"map", "the grid has no occupied cell",
                     "check occupied_thresh and negate of the map's YAML"};
}

Error no_room() {
  return {"map", "there is no place in it that a robot could look around from",
          "a smaller views.clearance_m may help; a grid needs free cells"};
}

Error nothing_found(Detector detector) {
  return {"map", "it has no feature that the detector \"" + std::string(to_string(detector)) + "\" finds",
          "use another detector, or a method that needs no features, as icp-full"};
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

  // 2. What the detector finds of them from all over the free space.
  const std::vector<PlanCorner> drawn = grid == nullptr && is_of_walls(detector)
                                            ? drawn_corners(plan, detector, detecting.detectors)
                                            : std::vector<PlanCorner>{};
  const RayCaster rays(std::move(walls));
  const std::vector<Pose2> views = choose_map_views(rays, grid, config.views);
  if (views.empty() && drawn.empty()) return no_room();
  const std::vector<MapFind> finds = look_around(rays, views, detector, detecting, config.views);
  const ViewsInSight sight(views, rays);
  std::vector<RepeatedFind> found = gather_repeated_finds(finds, sight, config.finds);
  if (!drawn.empty())
    found = prefer_drawn_corners(drawn, finds, found, sight, config.views.range_m, config.finds);
  if (found.empty()) return nothing_found(detector);

  // 3. What is not known of their places.
  const double of_cells_m = grid != nullptr ? grid->resolution_m / std::sqrt(12.0) : 0.0;
  const double sigma_m = std::max(config.map_sigma_m > 0.0 ? config.map_sigma_m : of_cells_m, kLeastSigma_m);
  FeatureMap built;
  std::vector<Eigen::Vector2d> points;
  built.features.reserve(found.size());
  built.evidence.reserve(found.size());
  points.reserve(found.size());
  for (RepeatedFind& find : found) {
    find.feature.covariance += sigma_m * sigma_m * Eigen::Matrix2d::Identity();
    built.features.push_back(find.feature);
    built.evidence.push_back(find.evidence);
    points.push_back(find.feature.point);
  }
  built.places = PointBuckets(points, kBucket_m);
  return built;
}

}  // namespace beaconless
