// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beaconless/map/grid_traversal.hpp"

namespace beaconless {
namespace {

constexpr double kMostCells = 1e8;         // along either axis
constexpr double kOffGrid_cells = 0.3819;  // so that walls at round numbers do not lie on borders of cells

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

/// A wall in a cell of the grid that pairs are looked for in.
struct Entry {
  Cell cell;
  std::uint32_t wall;

  friend bool operator<(const Entry& p, const Entry& q) {
    if (p.cell.y != q.cell.y) return p.cell.y < q.cell.y;
    if (p.cell.x != q.cell.x) return p.cell.x < q.cell.x;
    return p.wall < q.wall;
  }
  friend bool operator==(const Entry& p, const Entry& q) { return p.cell == q.cell && p.wall == q.wall; }
};

/// As long as the usual wall, and such that there are few cells a wall.
double cell_size_m(std::span<const Segment2> walls, double join_m, const Eigen::Vector2d& extent_m) {
  std::vector<double> lengths;
  lengths.reserve(walls.size());
  double total_m = 0.0;
  for (const Segment2& wall : walls) {
    lengths.push_back(wall.length_m());
    total_m += lengths.back();
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max({*middle, 0.1 * total_m / static_cast<double>(walls.size()), 4.0 * join_m,
                   extent_m.maxCoeff() / kMostCells});
}

/// The cells that each wall crosses, and those within `join_m` of its ends.
std::vector<Entry> enter_cells(std::span<const Segment2> walls, double join_m) {
  Eigen::Vector2d low = walls.front().a;
  Eigen::Vector2d high = low;
  for (const Segment2& wall : walls) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  const double cell_m = cell_size_m(walls, join_m, high - low);
  const auto in_cells = [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
    return ((point - low) / cell_m).array() + kOffGrid_cells;
  };
  std::vector<Entry> entries;
  entries.reserve(8 * walls.size());
  std::uint32_t index = 0;
  for (const Segment2& wall : walls) {
    const auto enter = [&entries, index](Cell cell) { entries.push_back({cell, index}); };
    ++index;
    traverse_cells(in_cells(wall.a), in_cells(wall.b), enter);
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(1.01 * join_m);
    for (const Eigen::Vector2d& end : {wall.a, wall.b}) {
      const Cell from = cell_of(in_cells(end - margin));
      const Cell to = cell_of(in_cells(end + margin));
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) enter({x, y});
    }
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  return entries;
}

/// Finds how two walls meet and notes it for both.
class Meeting {
 public:
  Meeting(std::span<const Segment2> walls, double join_m) : walls_(walls), join_m_(join_m) {}

  void look_at(std::uint32_t first, std::uint32_t second) {
    // Where an end is near, a crossing beside it is the same place.
    bool at_end = false;
    for (const auto& [wall, other] : {std::pair{first, second}, std::pair{second, first}})
      for (const Eigen::Vector2d& end : {walls_[other].a, walls_[other].b})
        if (walls_[wall].distance_m(end) <= join_m_) {
          note(wall, end);
          at_end = true;
        }
    if (at_end) return;
    if (const auto point = crossing(walls_[first], walls_[second])) {
      note(first, *point);
      note(second, *point);
    }
  }

  std::vector<WallContact> take() {
    std::sort(contacts_.begin(), contacts_.end(), [](const WallContact& p, const WallContact& q) {
      if (p.wall != q.wall) return p.wall < q.wall;
      if (p.along_m != q.along_m) return p.along_m < q.along_m;
      if (p.point.x() != q.point.x()) return p.point.x() < q.point.x();
      return p.point.y() < q.point.y();
    });
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end()), contacts_.end());
    return std::move(contacts_);
  }

 private:
  static std::optional<Eigen::Vector2d> crossing(const Segment2& p, const Segment2& q) {
    const Eigen::Vector2d along_p = p.b - p.a;
    const Eigen::Vector2d along_q = q.b - q.a;
    const double sine = cross(along_p, along_q);
    if (sine == 0.0) return std::nullopt;
    const double share_p = cross(q.a - p.a, along_q) / sine;
    const double share_q = cross(q.a - p.a, along_p) / sine;
    if (!(share_p >= 0.0 && share_p <= 1.0 && share_q >= 0.0 && share_q <= 1.0)) return std::nullopt;
    return p.a + share_p * along_p;
  }

  void note(std::uint32_t wall, const Eigen::Vector2d& point) {
    const Segment2& of = walls_[wall];
    const double length = of.length_m();
    contacts_.push_back({wall, std::clamp((point - of.a).dot(of.b - of.a) / length, 0.0, length), point});
  }

  std::span<const Segment2> walls_;
  double join_m_;
  std::vector<WallContact> contacts_;
};

}  // namespace

std::vector<WallContact> find_wall_contacts(std::span<const Segment2> walls, double join_m) {
  if (walls.empty()) return {};
  const std::vector<Entry> entries = enter_cells(walls, join_m);
  Meeting meeting(walls, join_m);
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin + 1;
    while (end < entries.size() && entries[end].cell == entries[begin].cell) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) meeting.look_at(entries[i].wall, entries[j].wall);
    begin = end;
  }
  return meeting.take();
}

}  // namespace beaconless
