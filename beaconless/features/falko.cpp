// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/falko.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "beaconless/features/corner_refinement.hpp"
#include "beaconless/features/local_maxima.hpp"
#include "beaconless/features/triangle_test.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// The neighbours of one side as seen from the centre, from it outwards: every so many, that no more than
/// `most` are left. `reach` is how many places that side has.
void collect(const BeamNeighbourhoods& around, std::size_t centre, std::size_t reach, bool forward, int most,
             FalkoSide& side) {
  const UnrolledScan& points = around.points;
  side.clear();
  const auto limit = static_cast<std::size_t>(most);
  const std::size_t step = most == 0 ? 1 : std::max<std::size_t>(1, (reach + limit - 1) / limit);
  for (std::size_t away = 1; away <= reach; away += step) {
    const std::size_t place = forward ? centre + away : centre - away;
    if (around.has(centre, place))
      side.add(points.x_m[place] - points.x_m[centre], points.y_m[place] - points.y_m[centre]);
  }
}

/// How much the directions of one side differ: the sector distances of all its pairs.
int disorder(FalkoSide& side, const Eigen::Vector2f& axis, const AngleSectors& sectors) {
  // 1. which sector each points into, seen from the axis
  for (std::size_t at = 0; at < side.count; at += 4) {
    const Floats4 x = load4(side.x.data() + at);
    const Floats4 y = load4(side.y.data() + at);
    store4(sectors.of(axis.x() * x + axis.y() * y, axis.x() * y - axis.y() * x), side.sector.data() + at);
  }
  // 2. how far four of them at a time are from each, which counts every pair twice
  const auto turn = static_cast<float>(sectors.count());
  Floats4 twice{};
  for (std::size_t at = 0; at < side.count; at += 4) {
    Floats4 from_all{};
    for (std::size_t other = 0; other < side.count; ++other) {
      const Floats4 way = abs4(load4(side.sector.data() + at) - side.sector[other]);
      from_all += way < turn - way ? way : turn - way;
    }
    twice += where(Ints4{0, 1, 2, 3} < static_cast<std::int32_t>(side.count - at), from_all);
  }
  return static_cast<int>(sum(twice)) / 2;
}

/// Scores a beam whose neighbourhood is a triangle; nothing when a side has too few points.
void score(const FalkoConfig& config, const Eigen::Matrix2f& to_axis, std::size_t beam, FalkoScratch& scratch,
           std::vector<Keypoint>& keypoints) {
  const BeamNeighbourhoods& around = scratch.around;
  const std::size_t centre = around.points.begin() + beam;
  collect(around, centre, centre - around.first[centre], false, config.max_points, scratch.left);
  collect(around, centre, around.last[centre] - centre, true, config.max_points, scratch.right);
  const auto min_points = static_cast<std::size_t>(config.min_points);
  if (scratch.left.count < min_points || scratch.right.count < min_points) return;
  const Eigen::Vector2f bisector = scratch.left.mean() + scratch.right.mean();
  const Eigen::Vector2f axis = to_axis * bisector;
  scratch.raw[beam] =
      disorder(scratch.left, axis, scratch.sectors) + disorder(scratch.right, axis, scratch.sectors);
  scratch.bisectors[beam] = bisector;
  keypoints.push_back(
      {beam, around.points.point(centre), 0.0, static_cast<double>(around.radius_m[centre]), 0.0});
}

/// Moves a keypoint from its beam to the corner that its sides make, if that is near.
void refine(Keypoint& keypoint, const FalkoConfig& config, const BeamNeighbourhoods& around) {
  const std::size_t centre = around.points.begin() + keypoint.beam;
  const std::size_t first = around.first[centre];
  const std::size_t last = around.last[centre];
  const auto corner = config.subbeam == SubBeam::arms
                          ? refine_corner(around.points, {first, centre - 1, centre + 1, last}, centre,
                                          {config.arm_m, 3.0 * config.sigma_m})
                          : meeting_point(around.points, {first, centre, centre, last});
  if (!corner || (corner->point - keypoint.point).norm() > config.subbeam_limit_m) return;
  keypoint.point = corner->point;
  if (config.subbeam == SubBeam::arms)
    keypoint.orientation_rad = wrap_angle(std::atan2(corner->bisector.y(), corner->bisector.x()));
}

}  // namespace

void detect_falko(const Scan& scan, const FalkoConfig& config, FalkoScratch& scratch,
                  std::vector<Keypoint>& keypoints) {
  BeamNeighbourhoods& around = scratch.around;
  around.assign(scan, config.radius);
  scratch.sectors.assign(config.sectors);
  scratch.raw.assign(scan.size(), FalkoScratch::kUntested);
  scratch.bisectors.resize(scan.size());
  const std::size_t most = around.points.size() + 4;
  scratch.left.make_room(most);
  scratch.right.make_room(most);
  keypoints.clear();

  // 1. the disorder of every neighbourhood that is a triangle
  const double turn = config.centred_sectors ? -kPi / scratch.sectors.count() : 0.0;
  const Eigen::Matrix2f to_axis = Eigen::Rotation2D<float>(static_cast<float>(turn)).toRotationMatrix();
  const auto share = static_cast<float>(1.0 / config.base_ratio);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = static_cast<double>(scan.ranges_m()[beam]);
    if (!scan.is_hit(beam) || range < config.range_min_m || range > config.range_max_m) continue;
    if (!is_triangle(around, around.points.begin() + beam, share)) continue;
    score(config, to_axis, beam, scratch, keypoints);
  }
  // 2. order as a score; those with enough of it
  const int greatest = std::max(1, *std::ranges::max_element(scratch.raw));
  for (Keypoint& keypoint : keypoints)
    keypoint.score = 1.0 - static_cast<double>(scratch.raw[keypoint.beam]) / greatest;
  std::erase_if(keypoints, [&](const Keypoint& k) { return !(k.score * 100.0 > config.min_score_percent); });
  // 3. the best of each place
  keep_local_maxima(scan, config.nms_radius_m, keypoints, scratch.candidates);
  // 4. which way they open, and where exactly
  for (Keypoint& keypoint : keypoints) {
    const Eigen::Vector2d bisector = scratch.bisectors[keypoint.beam].cast<double>();
    keypoint.orientation_rad = wrap_angle(std::atan2(bisector.y(), bisector.x()));
  }
  if (config.subbeam == SubBeam::off) return;
  for (Keypoint& keypoint : keypoints) refine(keypoint, config, around);
}

std::vector<Keypoint> detect_falko(const Scan& scan, const FalkoConfig& config) {
  FalkoScratch scratch;
  std::vector<Keypoint> keypoints;
  detect_falko(scan, config, scratch, keypoints);
  return keypoints;
}

void describe(Fields& fields, FalkoConfig& config) {
  fields("range_min_m", config.range_min_m, {0.0, 1000.0}, "nearer beams are not looked at");
  fields("range_max_m", config.range_max_m, {0.1, 1000.0}, "farther beams are not looked at");
  fields.section("radius", config.radius);
  fields("min_points", config.min_points, {1, 1000}, "least neighbours on each side");
  fields("max_points", config.max_points, {0, 10000},
         "neighbours on each side that are looked at, evenly thinned; 0: all");
  fields("base_ratio", config.base_ratio, {1.0, 100.0},
         "base and height of the triangle are at least the radius divided by this");
  fields("sectors", config.sectors, {4, 64},
         "sectors that the directions of neighbours are sorted into; rounded down to a multiple of four");
  fields("centred_sectors", config.centred_sectors, "the bisector is the middle of a sector, not a limit");
  fields("min_score_percent", config.min_score_percent, {0.0, 100.0},
         "least score, in percent of what the greatest disorder of the scan leaves");
  fields("nms_radius_m", config.nms_radius_m, {0.0, 10.0}, "only the best keypoint within this is kept");
  fields("subbeam", config.subbeam, {"off", "neighbourhood", "arms"},
         "the keypoint is put at its beam, or where the lines of its sides meet");
  fields("subbeam_limit_m", config.subbeam_limit_m, {0.0, 10.0},
         "a refinement further than this is not believed");
  fields("arm_m", config.arm_m, {0.01, 100.0}, "how long the sides may grow for the refinement");
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
}

Result<FalkoConfig> falko_preset(std::string_view name) {
  if (name == "beaconless") return FalkoConfig{};
  FalkoConfig config{.radius = {.at_zero_m = 0.1, .growth_per_m = 0.07},
                     .max_points = 0,
                     .base_ratio = 2.5,
                     .centred_sectors = false,
                     .nms_radius_m = 0.1,
                     .subbeam = SubBeam::neighbourhood};
  if (name == "authors") return config;
  if (name == "dissertation") {
    config.range_min_m = 0.01;
    config.nms_radius_m = 0.03;
    config.radius = {.at_zero_m = 0.1, .growth_per_m = 0.05};
    config.base_ratio = 5.5;
    return config;
  }
  return Error{"falko preset \"" + std::string(name) + "\"", "there is no such preset",
               "use beaconless, authors or dissertation"};
}

}  // namespace beaconless
