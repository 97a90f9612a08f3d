// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "beaconless/map/plan_corners.hpp"

namespace beaconless {
namespace {

constexpr double kLeastSigma_m = 1e-3;

Eigen::Matrix2d round_covariance(double sigma_m) {
  const double sigma = std::max(sigma_m, kLeastSigma_m);
  return sigma * sigma * Eigen::Matrix2d::Identity();
}

/// Those corners of a plan that the detector would not refuse for their angle or their walls.
std::vector<PointFeature> read_off(const FloorPlan& plan, Detector detector, const DetectorsConfig& detecting,
                                   const FeatureMapConfig& config) {
  const bool vertices = detector == Detector::rdp;
  const double min_arm_m = vertices ? detecting.rdp.min_arm_m : detecting.corners.min_arm_m;
  PlanCornersConfig corners;
  corners.min_angle_deg =
      std::min(80.0, vertices ? detecting.rdp.min_angle_deg : detecting.corners.min_angle_deg);
  std::vector<PointFeature> features;
  for (const PlanCorner& corner : find_plan_corners(plan, corners))
    if (corner.arm_m >= min_arm_m)
      features.push_back(
          {corner.point, round_covariance(config.map_sigma_m), corner.orientation_rad, corner.opening_rad});
  return features;
}

}  // namespace

void describe(Fields& fields, FeatureMapConfig& config) {
  fields("map_sigma_m", config.map_sigma_m, {0.0, 1.0},
         "standard deviation of the map's walls; 0: none for a floor plan, that of its cells for a grid");
  fields("view_step_m", config.view_step_m, {0.05, 10.0},
         "distance between the places that the map is looked at from");
  fields("view_clearance_m", config.view_clearance_m, {0.0, 5.0}, "no wall is nearer to them");
  fields("view_range_m", config.view_range_m, {1.0, 1000.0}, "how far is looked");
  fields("view_beam_deg", config.view_beam_deg, {0.05, 5.0}, "between two beams; that of the scanner");
  fields("max_views", config.max_views, {10, 100000}, "of larger maps the step is made larger");
  fields("same_place_m", config.same_place_m, {0.005, 1.0},
         "finds within this distance of their mean are one feature");
  fields("same_turn_deg", config.same_turn_deg, {1.0, 180.0}, "… if they are turned alike to within this");
  fields("min_views", config.min_views, {1, 10000}, "features found in fewer views are left out");
  fields("min_share", config.min_share, {0.0, 1.0},
         "features found in a smaller share of the views that see their place are left out");
}

Result<FeatureMap> build_feature_map(const Map& map, Detector detector, const PointFeaturesConfig& detecting,
                                     const FeatureMapConfig& config) {
  FeatureMap built;
  if (const auto* plan = std::get_if<FloorPlan>(&map))
    built.features = read_off(*plan, detector, detecting.detectors, config);
  if (built.features.empty())
    return Error{"map", "no " + std::string(to_string(detector)) + " found", "use another method"};
  built.evidence.resize(built.features.size());
  std::vector<Eigen::Vector2d> points;
  points.reserve(built.features.size());
  for (const PointFeature& feature : built.features) points.push_back(feature.point);
  built.places = PointBuckets(points, 1.0);
  return built;
}

}  // namespace beaconless
