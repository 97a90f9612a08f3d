// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/split.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "beaconless/features/segment_by_distance.hpp"

namespace beaconless {
namespace {

// Points on a line parallel to the chord are equally far but for rounding: the first is taken, a vertex.
constexpr double kTie = 1.0 + 1e-12;

/// The point of a piece that lies farthest from its chord; `index` is the piece's first where none lies off
/// it.
struct Farthest {
  std::size_t index = 0;
  double square = 0.0;  // m²
};

/// Points as they come, in double.
struct PlainRow {
  std::span<const Eigen::Vector2d> points;

  Farthest farthest(std::size_t first, std::size_t last) const {
    const Eigen::Vector2d a = points[first];
    const Eigen::Vector2d chord = points[last] - a;
    const double length_square = chord.squaredNorm();
    Farthest best{first, 0.0};
    for (std::size_t i = first + 1; i < last; ++i) {
      const Eigen::Vector2d arm = points[i] - a;
      const double cross = chord.x() * arm.y() - chord.y() * arm.x();
      const double square = length_square > 0.0 ? cross * cross / length_square : arm.squaredNorm();
      if (square > kTie * best.square) best = {i, square};
    }
    return best;
  }
};

/// Points of a scan, in float and eight lanes.
///
/// A first pass finds how far the farthest is, block by block, and a second one in which block and where:
/// both vectorise without help of the instruction set, where an index carried along does not.
struct ScanRow {
  static constexpr std::size_t kBlock = 32;

  const float* x;
  const float* y;

  /// |a x + b y + c| is the measure, in units of the chord's length; or the distance from a point.
  template <class Measure>
  static std::size_t arg_max(const Measure& measure, std::size_t begin, std::size_t end, float& most) {
    constexpr std::size_t kLanes = 8;
    std::size_t best_block = begin;
    most = 0.0F;
    std::size_t i = begin;
    for (; i + kBlock <= end; i += kBlock) {
      std::array<float, kLanes> lane{};
      for (std::size_t k = 0; k < kBlock; k += kLanes)
        for (std::size_t l = 0; l < kLanes; ++l) {
          const float value = measure(i + k + l);
          lane[l] = lane[l] > value ? lane[l] : value;
        }
      for (std::size_t half = kLanes / 2; half > 0; half /= 2)
        for (std::size_t l = 0; l < half; ++l) lane[l] = lane[l] > lane[l + half] ? lane[l] : lane[l + half];
      if (lane[0] > most) {
        most = lane[0];
        best_block = i;
      }
    }
    float rest = most;
    std::size_t best = end;
    for (; i < end; ++i)
      if (const float value = measure(i); value > rest) {
        rest = value;
        best = i;
      }
    if (best < end) {
      most = rest;
      return best;
    }
    for (std::size_t k = best_block; k < std::min(best_block + kBlock, end); ++k)
      if (!(measure(k) < most)) return k;
    return begin;
  }

  Farthest farthest(std::size_t first, std::size_t last) const {
    const float ax = x[first];
    const float ay = y[first];
    const float dx = x[last] - ax;
    const float dy = y[last] - ay;
    const float length_square = dx * dx + dy * dy;
    float most = 0.0F;
    Farthest best{first, 0.0};
    if (length_square > 0.0F) {
      const auto cross = [this, ax, ay, dx, dy](std::size_t i) {
        return std::abs(dx * (y[i] - ay) - dy * (x[i] - ax));
      };
      best.index = arg_max(cross, first + 1, last, most);
      best.square =
          static_cast<double>(most) * static_cast<double>(most) / static_cast<double>(length_square);
    } else {
      const auto square = [this, ax, ay](std::size_t i) {
        return (x[i] - ax) * (x[i] - ax) + (y[i] - ay) * (y[i] - ay);
      };
      best.index = arg_max(square, first + 1, last, most);
      best.square = static_cast<double>(most);
    }
    return best;
  }
};

/// Appends the vertices of [first, last] except the first.
template <class Row>
void split_run(const Row& row, std::size_t first, std::size_t last, double epsilon_square,
               std::vector<std::pair<std::size_t, std::size_t>>& stack, std::vector<std::size_t>& vertices) {
  stack.clear();
  stack.emplace_back(first, last);
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    if (b > a + 1) {
      const Farthest farthest = row.farthest(a, b);
      if (farthest.square > epsilon_square) {
        // The left half next, so that vertices come out ascending.
        stack.back().first = farthest.index;
        stack.emplace_back(a, farthest.index);
        continue;
      }
    }
    stack.pop_back();
    vertices.push_back(b);
  }
}

/// The point of a run that lies farthest from its first.
std::size_t farthest_from_first(const ScanRow& row, std::size_t first, std::size_t last) {
  std::size_t best = last;
  float most = 0.0F;
  for (std::size_t i = first + 1; i < last; ++i) {
    const float dx = row.x[i] - row.x[first];
    const float dy = row.y[i] - row.y[first];
    if (const float square = dx * dx + dy * dy; square > most) {
      most = square;
      best = i;
    }
  }
  return best;
}

}  // namespace

void describe(Fields& fields, SplitConfig& config) {
  fields("epsilon_m", config.epsilon_m, {1e-6, 100.0},
         "points further than this from a straight piece cut it in two; four to five sigmas of the laser");
}

void split(std::span<const Eigen::Vector2d> points, const SplitConfig& config, SplitScratch& scratch,
           std::vector<std::size_t>& vertices) {
  vertices.clear();
  if (points.empty()) return;
  vertices.push_back(0);
  if (points.size() == 1) return;
  split_run(PlainRow{points}, 0, points.size() - 1, config.epsilon_m * config.epsilon_m, scratch.stack,
            vertices);
}

std::vector<std::size_t> split(std::span<const Eigen::Vector2d> points, const SplitConfig& config) {
  SplitScratch scratch;
  std::vector<std::size_t> vertices;
  split(points, config, scratch, vertices);
  return vertices;
}

void split(const Scan& scan, std::span<const ScanSegment> segments, const SplitConfig& config,
           SplitScratch& scratch, std::vector<ScanSegment>& pieces) {
  pieces.clear();
  const OrderedPoints points = ordered_points(scan, segments, scratch.points);
  const ScanRow row{points.x_m.data(), points.y_m.data()};
  const double epsilon_square = config.epsilon_m * config.epsilon_m;
  for (const ScanSegment& segment : segments) {
    if (segment.count == 0) continue;
    const std::size_t first = points.place_of(segment);
    const std::size_t last = first + segment.count - 1;
    if (first == last) {
      pieces.push_back(segment);
      continue;
    }
    // 1. Vertices; a contour that closes has no chord of its own and gets two.
    scratch.vertices.clear();
    if (segment.count == scan.size() && scan.is_full_circle()) {
      const std::size_t across = farthest_from_first(row, first, last);
      split_run(row, first, across, epsilon_square, scratch.stack, scratch.vertices);
      if (across != last) split_run(row, across, last, epsilon_square, scratch.stack, scratch.vertices);
    } else {
      split_run(row, first, last, epsilon_square, scratch.stack, scratch.vertices);
    }
    // 2. The pieces between them.
    std::size_t from = first;
    for (const std::size_t to : scratch.vertices) {
      pieces.push_back({points.beam_at(from), to - from + 1});
      from = to;
    }
  }
}

std::vector<ScanSegment> split(const Scan& scan, std::span<const ScanSegment> segments,
                               const SplitConfig& config) {
  SplitScratch scratch;
  std::vector<ScanSegment> pieces;
  split(scan, segments, config, scratch, pieces);
  return pieces;
}

std::vector<ScanSegment> split(const Scan& scan, const SplitConfig& config) {
  // No two hits are further apart than this.
  const double no_jump_m = 1e9;
  const DistanceSegmentationConfig hits_only{.threshold = DistanceThreshold::constant,
                                             .constant_m = no_jump_m};
  return split(scan, segment_by_distance(scan, hits_only), config);
}

}  // namespace beaconless
