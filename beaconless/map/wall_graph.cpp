// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_buckets.hpp"
#include "beaconless/map/wall_contacts.hpp"

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e8;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// An arm and the node it leaves.
struct Departure {
  std::uint32_t from;
  WallGraph::Arm arm;
};

bool is_before(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
}

/// The walls that can be used, each once, whichever way round it was drawn.
std::vector<Segment2> usable_walls(const FloorPlan& plan) {
  std::vector<Segment2> walls = plan.segments();
  std::erase_if(walls, [](const Segment2& wall) {
    return !wall.a.allFinite() || !wall.b.allFinite() ||
           std::max(wall.a.cwiseAbs().maxCoeff(), wall.b.cwiseAbs().maxCoeff()) > kFarthest_m;
  });
  for (Segment2& wall : walls)
    if (is_before(wall.b, wall.a)) std::swap(wall.a, wall.b);
  std::sort(walls.begin(), walls.end(), [](const Segment2& p, const Segment2& q) {
    return p.a != q.a ? is_before(p.a, q.a) : is_before(p.b, q.b);
  });
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  return walls;
}

/// Gives every point its node: the first point within `join_m` that has no other. Appends the nodes.
std::vector<std::uint32_t> join(const std::vector<Eigen::Vector2d>& points, double join_m,
                                std::vector<Eigen::Vector2d>& nodes) {
  const PointBuckets near(points, std::max(join_m, 1e-3));
  std::vector<std::uint32_t> node_of(points.size(), kNone);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (node_of[i] != kNone) continue;
    const auto node = static_cast<std::uint32_t>(nodes.size());
    near.for_each_within(points[i], join_m, [&](std::size_t j) {
      if (node_of[j] == kNone) node_of[j] = node;
    });
    nodes.push_back(points[i]);
  }
  return node_of;
}

/// Orders arms by node and direction and keeps one of those that lead to the same node.
void add_arms(std::vector<Departure>& departures, WallGraph& graph) {
  std::stable_sort(departures.begin(), departures.end(), [](const Departure& p, const Departure& q) {
    return p.from != q.from ? p.from < q.from : p.arm.node < q.arm.node;
  });
  const auto is_same = [](const Departure& p, const Departure& q) {
    return p.from == q.from && p.arm.node == q.arm.node;
  };
  departures.erase(std::unique(departures.begin(), departures.end(), is_same), departures.end());
  std::stable_sort(departures.begin(), departures.end(), [](const Departure& p, const Departure& q) {
    return p.from != q.from ? p.from < q.from : p.arm.direction_rad < q.arm.direction_rad;
  });
  graph.first.assign(graph.nodes.size() + 1, 0);
  graph.arms.reserve(departures.size());
  for (const Departure& departure : departures) {
    ++graph.first[departure.from + 1];
    graph.arms.push_back(departure.arm);
  }
  for (std::size_t n = 1; n < graph.first.size(); ++n) graph.first[n] += graph.first[n - 1];
}

}  // namespace

WallGraph build_wall_graph(const FloorPlan& plan, double join_m) {
  WallGraph graph;
  // 1. Where walls end and where they meet, in order along each wall.
  const std::vector<Segment2> walls = usable_walls(plan);
  const std::vector<WallContact> contacts = find_wall_contacts(walls, join_m);
  std::vector<Eigen::Vector2d> points;
  std::vector<std::size_t> last_of;  // one past the last point of each wall
  points.reserve(2 * walls.size() + contacts.size());
  last_of.reserve(walls.size());
  std::size_t contact = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    points.push_back(walls[i].a);
    for (; contact < contacts.size() && contacts[contact].wall == i; ++contact)
      points.push_back(contacts[contact].point);
    points.push_back(walls[i].b);
    last_of.push_back(points.size());
  }
  // 2. What is near is one node.
  const std::vector<std::uint32_t> node_of = join(points, join_m, graph.nodes);
  // 3. A wall is the pieces from node to node.
  std::vector<Departure> departures;
  departures.reserve(2 * points.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Eigen::Vector2d along = walls[i].b - walls[i].a;
    const double forth = wrap_angle(std::atan2(along.y(), along.x()));
    const double back = wrap_angle(forth + kPi);
    for (; k + 1 < last_of[i]; ++k) {
      const std::uint32_t from = node_of[k];
      const std::uint32_t to = node_of[k + 1];
      if (from == to) continue;
      const double length = (graph.nodes[to] - graph.nodes[from]).norm();
      departures.push_back({from, {forth, length, to}});
      departures.push_back({to, {back, length, from}});
    }
    ++k;
  }
  add_arms(departures, graph);
  return graph;
}

}  // namespace beaconless
