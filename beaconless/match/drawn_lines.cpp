// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/drawn_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace beaconless {
namespace {

constexpr std::size_t kLeastDrawn = 5;  // columns that tell a line
constexpr double kSteepest = 1.2;       // slope against the axis that a wall is nearer to
constexpr double kSteep = 0.4;          // two cells a column are a line's own from here
constexpr std::array<double, 4> kSlack{0.0, 0.05, 0.1, 0.2};  // of cells that stray by more than rounding
constexpr std::size_t kPicked = 12;                           // pairs of these many and one are tried …
constexpr double kNear_cells = 0.75;                          // … for a line that passes so near …
constexpr double kMostShare = 0.6;                            // … so many of the columns

/// What a line can still be: a convex polygon of (slope, across).
class PossibleLines {
 public:
  PossibleLines(double across, double most_off)
      : corners_{{-kSteepest, across - most_off},
                 {kSteepest, across - most_off},
                 {kSteepest, across + most_off},
                 {-kSteepest, across + most_off}} {}

  /// Shuts out all that are not between two heights, so far along from the middle.
  void pass(double along, double low, double high) {
    cut({along, 1.0}, high);
    cut({-along, -1.0}, -low);
  }

  bool none() const { return corners_.size() < 3; }

  Eigen::Vector2d centroid() const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double area = 0.0;
    const Eigen::Vector2d& first = corners_.front();
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      const Eigen::Vector2d p = corners_[i - 1] - first;
      const Eigen::Vector2d q = corners_[i] - first;
      const double twice = p.x() * q.y() - p.y() * q.x();
      area += twice;
      sum += twice * (p + q);
    }
    if (area > 1e-12) return first + sum / (3.0 * area);
    for (const Eigen::Vector2d& corner : corners_) sum += corner - first;
    return first + sum / static_cast<double>(corners_.size());
  }

 private:
  /// Keeps what has facing · corner <= most.
  void cut(const Eigen::Vector2d& facing, double most) {
    if (none()) return;
    kept_.clear();
    Eigen::Vector2d before = corners_.back();
    double before_over = facing.dot(before) - most;
    for (const Eigen::Vector2d& corner : corners_) {
      const double over = facing.dot(corner) - most;
      if ((over > 0.0) != (before_over > 0.0))
        kept_.emplace_back(before + before_over / (before_over - over) * (corner - before));
      if (over <= 0.0) kept_.push_back(corner);
      before = corner;
      before_over = over;
    }
    corners_.swap(kept_);
  }

  std::vector<Eigen::Vector2d> corners_;
  std::vector<Eigen::Vector2d> kept_;
};

}  // namespace

std::optional<CellsLine> drawn_line(const std::vector<WallColumn>& columns) {
  if (columns.size() < kLeastDrawn) return std::nullopt;
  const auto [first, last] =
      std::minmax_element(columns.begin(), columns.end(),
                          [](const WallColumn& p, const WallColumn& q) { return p.along < q.along; });
  CellsLine line;
  line.middle = 0.5 * (first->along + last->along);
  const double rise = last->across - first->across;
  const double run = last->along - first->along;
  if (run + 1.0 < static_cast<double>(kLeastDrawn)) return std::nullopt;
  const bool is_steep = std::abs(rise) > kSteep * run;
  for (const double slack : kSlack) {
    PossibleLines possible(0.5 * (first->across + last->across), 2.0 * run + 2.0);
    for (const WallColumn& column : columns) {
      if (possible.none()) break;
      const double along = column.along - line.middle;
      const double low = column.across - slack;
      const double high = column.across + slack;
      if (column.cells == 1) {
        possible.pass(along - 0.5, low - 0.5, high + 0.5);
        possible.pass(along + 0.5, low - 0.5, high + 0.5);
      } else if (column.cells == 2 && is_steep) {  // from the one into the other
        possible.pass(along - std::copysign(0.5, rise), low - 1.0, high);
        possible.pass(along + std::copysign(0.5, rise), low, high + 1.0);
      } else {
        possible.pass(along, low - 0.5, high + 0.5);
      }
    }
    if (possible.none()) continue;
    const Eigen::Vector2d mean = possible.centroid();
    line.slope = mean.x();
    line.across = mean.y();
    line.slack = slack;
    return line;
  }
  return std::nullopt;
}

std::optional<CellsLine> drawn_line_of_most(const std::vector<WallColumn>& columns,
                                            std::vector<WallColumn>& near) {
  near.clear();
  if (columns.size() < kLeastDrawn) return std::nullopt;
  const auto picked = [&](std::size_t k) -> const WallColumn& {
    return columns[k * (columns.size() - 1) / kPicked];
  };
  std::ptrdiff_t most = 0;
  for (std::size_t first = 0; first < kPicked; ++first)
    for (std::size_t last = first + 1; last <= kPicked; ++last) {
      const WallColumn& on = picked(first);
      const double run = picked(last).along - on.along;
      if (std::abs(run) < 3.0) continue;
      const double slope = (picked(last).across - on.across) / run;
      const auto is_near = [&](const WallColumn& at) {
        return std::abs(at.across - on.across - slope * (at.along - on.along)) < kNear_cells;
      };
      const auto count = std::count_if(columns.begin(), columns.end(), is_near);
      if (count <= most) continue;
      most = count;
      near.clear();
      std::copy_if(columns.begin(), columns.end(), std::back_inserter(near), is_near);
    }
  if (static_cast<double>(most) < kMostShare * static_cast<double>(columns.size())) return std::nullopt;
  return drawn_line(near);
}

}  // namespace beaconless
