// SPDX-License-Identifier: Apache-2.0
#include "reproduce_misleading.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/map/plan_corners.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/sim/world.hpp"

namespace beaconless::cli {
namespace {

constexpr double kReach_m = 0.3;
constexpr double kTogether_m = 0.4;
constexpr double kBeforeCorner_m = 0.03;  // a ray to a corner ends here, before it grazes a wall of it
constexpr double kSameCorner_m = 1e-6;
constexpr double kLeastTurn_deg = 50.0;

/// Corners that a scan can find: those of bins with many short sides are none.
std::vector<Eigen::Vector2d> corners_of(const FloorPlan& plan) {
  std::vector<Eigen::Vector2d> corners;
  for (const PlanCorner& corner : find_plan_corners(plan, {.min_angle_deg = kLeastTurn_deg}))
    if (corners.empty() || (corners.back() - corner.point).norm() > kSameCorner_m)
      corners.push_back(corner.point);
  return corners;
}

}  // namespace

Eigen::Vector2d MapDisagreement::worst_place() const {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::ptrdiff_t most = 0;
  for (const Eigen::Vector2d& hit : far_hits) {
    const auto around = std::ranges::count_if(
        far_hits, [&](const Eigen::Vector2d& other) { return (other - hit).norm() < kTogether_m; });
    if (around <= most) continue;
    most = around;
    place = hit;
  }
  return place;
}

MapDisagreement worst_disagreement(const Scene& scene, const FloorPlan& map) {
  const WallIndex walls(map, kReach_m);
  const double far_m = 3.0 * scene.scenario.lidar.range_sigma_m;
  MapDisagreement worst;
  std::vector<Eigen::Vector2d> far_hits;
  for (std::size_t i = 0; i < scene.run.events.size(); ++i) {
    const Scan& scan = scene.scan(i);
    const Pose2 map_from_laser = scene.run.truth[i].pose * scene.scenario.base_from_laser;
    double sum_m = 0.0;
    far_hits.clear();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (!scan.is_hit(beam)) continue;
      const Eigen::Vector2d hit = map_from_laser * scan.point(beam);
      const auto nearest = walls.nearest(hit);
      const double distance_m = nearest ? (hit - nearest->point).norm() : kReach_m;
      sum_m += distance_m;
      if (distance_m > far_m) far_hits.push_back(hit);
    }
    const double mean_m = scan.hit_count() == 0 ? 0.0 : sum_m / static_cast<double>(scan.hit_count());
    if (mean_m > worst.mean_m) worst = {i, mean_m, far_hits};
  }
  return worst;
}

double HiddenCorners::hidden_share() const {
  const std::size_t all = hidden.size() + seen.size();
  return all == 0 ? 0.0 : static_cast<double>(hidden.size()) / static_cast<double>(all);
}

HiddenCorners most_hidden_corners(const Scene& scene) {
  const sim::World empty(scene.scenario.plan, {});
  const sim::World peopled(scene.scenario.plan, scene.scenario.people);
  const auto corners = corners_of(scene.scenario.plan);
  const double field_rad = radians(scene.scenario.lidar.angle_max_deg);
  HiddenCorners most;
  for (std::size_t i = 0; i < scene.run.events.size(); ++i) {
    const Pose2 map_from_laser = scene.run.truth[i].pose * scene.scenario.base_from_laser;
    const double time_s = static_cast<double>(i) / scene.scenario.lidar.rate_hz;
    HiddenCorners here{.scan = i};
    for (const Eigen::Vector2d& corner : corners) {
      const Eigen::Vector2d ray = corner - map_from_laser.translation();
      const Eigen::Vector2d seen_from_laser = map_from_laser.inverse() * corner;
      if (std::abs(std::atan2(seen_from_laser.y(), seen_from_laser.x())) > field_rad) continue;
      const double free_m = ray.norm() - kBeforeCorner_m;
      if (free_m <= 0.0) continue;
      const Eigen::Vector2d direction = ray.normalized();
      if (empty.range_m(map_from_laser.translation(), direction, free_m, time_s)) continue;
      const bool is_hidden =
          peopled.range_m(map_from_laser.translation(), direction, free_m, time_s).has_value();
      (is_hidden ? here.hidden : here.seen).push_back(corner);
    }
    if (i > 0 && here.hidden_share() <= most.hidden_share()) continue;
    for (const sim::Person& person : scene.scenario.people) here.people.push_back(person.position_m(time_s));
    most = std::move(here);
  }
  return most;
}

}  // namespace beaconless::cli
