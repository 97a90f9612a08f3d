// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/vertices.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// The whole scan as runs of hits, which only beams that are no hits part.
void runs_of_hits(const Scan& scan, std::vector<ScanSegment>& segments) {
  segments.clear();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!scan.is_hit(beam)) continue;
    if (!segments.empty() && segments.back().first + segments.back().count == beam)
      ++segments.back().count;
    else
      segments.push_back({beam, 1});
  }
}

}  // namespace

void describe(Fields& fields, VerticesConfig& config) {
  fields("is_segmented_first", config.is_segmented_first, "part objects before splitting");
  fields.section("segmentation", config.segmentation);
  fields.section("splitting", config.splitting);
  fields("min_angle_deg", config.min_angle_deg, {1.0, 179.0}, "least turn of the polyline at a corner");
  fields("min_arm_m", config.min_arm_m, {0.0, 10.0}, "least length of both pieces at a corner");
}

void find_vertices(const Scan& scan, const VerticesConfig& config, VerticesScratch& scratch,
                   std::vector<Keypoint>& keypoints) {
  keypoints.clear();
  // 1. Part the scan into objects and these into straight pieces.
  if (config.is_segmented_first)
    segment_by_distance(scan, config.segmentation, scratch.segmentation, scratch.segments);
  else
    runs_of_hits(scan, scratch.segments);
  split(scan, scratch.segments, config.splitting, scratch.splitting, scratch.pieces);
  // 2. Where a piece ends at the beam at which the next begins, both meet.
  for (std::size_t i = 0; i + 1 < scratch.pieces.size(); ++i) {
    const ScanSegment& before = scratch.pieces[i];
    const ScanSegment& after = scratch.pieces[i + 1];
    if (before.beam(before.count - 1, scan.size()) != after.first) continue;
    const Eigen::Vector2d corner = scan.point(after.first);
    const Eigen::Vector2d to_before = scan.point(before.first) - corner;
    const Eigen::Vector2d to_after = scan.point(after.beam(after.count - 1, scan.size())) - corner;
    const double arm_m = std::min(to_before.norm(), to_after.norm());
    if (!(arm_m > 0.0) || arm_m < config.min_arm_m) continue;
    // 3. A corner is where the way turns.
    const Eigen::Vector2d bisector = to_before.normalized() + to_after.normalized();
    const double opening_rad = std::acos(std::clamp(0.5 * bisector.squaredNorm() - 1.0, -1.0, 1.0));
    const double turn_rad = kPi - opening_rad;
    if (turn_rad < radians(config.min_angle_deg)) continue;
    keypoints.push_back({.beam = after.first,
                         .point = corner,
                         .orientation_rad = wrap_angle(std::atan2(bisector.y(), bisector.x())),
                         .scale_m = arm_m,
                         .score = turn_rad});
  }
}

std::vector<Keypoint> find_vertices(const Scan& scan, const VerticesConfig& config) {
  VerticesScratch scratch;
  std::vector<Keypoint> keypoints;
  find_vertices(scan, config, scratch, keypoints);
  return keypoints;
}

}  // namespace beaconless
