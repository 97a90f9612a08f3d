// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/plan_corners.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/wall_graph.hpp"

namespace beaconless {
namespace {

enum class Side { left, right };

/// The arm that goes on where a wall arrives at `node` from `from`, for somebody who has the wall's other end
/// behind and looks along one side of it.
const WallGraph::Arm& next_arm(const WallGraph& graph, std::uint32_t node, std::uint32_t from, Side side) {
  const auto arms = graph.arms_of(node);
  std::size_t back = 0;
  while (back + 1 < arms.size() && arms[back].node != from) ++back;
  const std::size_t step = side == Side::left ? arms.size() - 1 : 1;
  return arms[(back + step) % arms.size()];
}

/// How far a wall goes on straight as seen from one of its sides, whatever joins it on the other.
double straight_m(const WallGraph& graph, std::uint32_t from, const WallGraph::Arm& first, Side side,
                  double max_turn_rad) {
  double length = first.length_m;
  std::uint32_t node = first.node;
  // Every step leads on in about the first one's direction, so that there is an end; pieces shorter than what
  // is joined may lead anywhere.
  for (std::size_t step = 0; step < graph.nodes.size(); ++step) {
    const WallGraph::Arm& arm = next_arm(graph, node, from, side);
    if (!(std::abs(wrap_angle(arm.direction_rad - first.direction_rad)) < max_turn_rad)) break;
    length += arm.length_m;
    from = node;
    node = arm.node;
  }
  return length;
}

/// The corner in the gap from one arm of a node counter-clockwise to the next; its arms may be the far sides
/// of a gap of more than pi.
PlanCorner corner_in(const WallGraph& graph, std::uint32_t node, const WallGraph::Arm& right,
                     const WallGraph::Arm& left, double gap_rad, double max_turn_rad) {
  const double middle = right.direction_rad + 0.5 * gap_rad;
  return {.point = graph.nodes[node],
          .orientation_rad = wrap_angle(gap_rad < kPi ? middle : middle + kPi),
          .opening_rad = std::min(gap_rad, 2.0 * kPi - gap_rad),
          .arm_m = std::min(straight_m(graph, node, right, Side::left, max_turn_rad),
                            straight_m(graph, node, left, Side::right, max_turn_rad))};
}

}  // namespace

void describe(Fields& fields, PlanCornersConfig& config) {
  fields("min_angle_deg", config.min_angle_deg, {0.1, 89.0}, "least angle between the walls of a corner");
  fields("join_m", config.join_m, {0.0, 1.0}, "walls that come this near to each other meet");
}

std::vector<PlanCorner> find_plan_corners(const FloorPlan& plan, const PlanCornersConfig& config) {
  const WallGraph graph = build_wall_graph(plan, config.join_m);
  const double min_angle = radians(config.min_angle_deg);
  std::vector<PlanCorner> corners;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    const auto arms = graph.arms_of(node);
    if (arms.size() < 2) continue;
    const std::size_t begin = corners.size();
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const std::size_t next = i + 1 < arms.size() ? i + 1 : 0;
      double gap = arms[next].direction_rad - arms[i].direction_rad;
      if (next == 0) gap += 2.0 * kPi;
      const double opening = std::min(gap, 2.0 * kPi - gap);
      if (opening < min_angle || opening > kPi - min_angle) continue;
      corners.push_back(corner_in(graph, node, arms[i], arms[next], gap, min_angle));
    }
    // Both sides of two walls are one corner.
    if (arms.size() == 2 && corners.size() == begin + 2) {
      corners[begin].arm_m = std::max(corners[begin].arm_m, corners[begin + 1].arm_m);
      corners.pop_back();
    }
  }
  std::sort(corners.begin(), corners.end(), [](const PlanCorner& p, const PlanCorner& q) {
    if (p.point.x() != q.point.x()) return p.point.x() < q.point.x();
    if (p.point.y() != q.point.y()) return p.point.y() < q.point.y();
    return p.orientation_rad < q.orientation_rad;
  });
  return corners;
}

}  // namespace beaconless
