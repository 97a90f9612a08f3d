// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/beta_grid.hpp"

#include <bit>
#include <limits>
#include <numbers>

#include "beaconless/features/descriptor_cells.hpp"

namespace beaconless {
namespace {

constexpr int kSectors = BetaGrid::kSectors;
constexpr std::size_t kRings = BetaGrid::kRings;

/// The sector of a point of the keypoint's frame; the same borders as PolarCells has.
unsigned sector_of(double u, double v) {
  constexpr double kThird = std::numbers::inv_sqrt3;  // tan 30°
  constexpr double kTwoThirds = std::numbers::sqrt3;  // tan 60°
  const double across = std::abs(v);
  const double along = std::abs(u);
  unsigned sector = (across >= kThird * along ? 1U : 0U) + (across >= kTwoThirds * along ? 1U : 0U);
  sector = u >= 0.0 ? sector : 5U - sector;
  return v >= 0.0 ? sector : 11U - sector;
}

/// The sectors from one to the other, both with them, counter-clockwise; bit s is sector s.
std::uint64_t sectors_between(unsigned from, unsigned to) {
  const unsigned steps = (to + kSectors - from) % kSectors;
  // A straight line sweeps less than half a turn; more is a touch of a border, seen from its other side.
  if (steps > kSectors / 2) return (std::uint64_t{1} << from) | (std::uint64_t{1} << to);
  const std::uint64_t run = ((std::uint64_t{2} << steps) - 1U) << from;
  return (run | (run >> static_cast<unsigned>(kSectors))) & ((std::uint64_t{1} << kSectors) - 1U);
}

/// The rays of one scan as the keypoint sees them.
class RaysAround {
 public:
  RaysAround(const Keypoint& keypoint, double inner_m, double outer_m)
      : origin_(-keypoint.point),
        axis_(std::cos(keypoint.orientation_rad), std::sin(keypoint.orientation_rad)) {
    for (std::size_t r = 0; r <= kRings; ++r) {
      const double radius_m = inner_m + (outer_m - inner_m) * static_cast<double>(r) / kRings;
      squares_[r] = radius_m * radius_m;
    }
  }

  /// The cells that a ray passes through on its first `length_m` metres, a bit each.
  std::uint64_t passed(const Eigen::Vector2d& direction, double length_m) const {
    // 1. Where the ray is nearest to the keypoint, and how near.
    const double nearest_m = -origin_.dot(direction);
    const double miss_m = origin_.x() * direction.y() - origin_.y() * direction.x();
    const double u = axis_.dot(direction);
    const double v = axis_.x() * direction.y() - axis_.y() * direction.x();
    const Eigen::Vector2d foot = origin_ + nearest_m * direction;
    const double foot_u = axis_.dot(foot);
    const double foot_v = axis_.x() * foot.y() - axis_.y() * foot.x();

    // 2. Cut it by the rings, from the outside inwards; 3. both pieces in a ring sweep their sectors.
    std::uint64_t cells = 0;
    double outer = half_chord(kRings, miss_m);
    if (outer < 0.0) return 0;
    const auto sweep = [&](std::size_t ring, double from, double to) {
      from = std::max(from, -nearest_m);
      to = std::min(to, length_m - nearest_m);
      if (!(from < to)) return;
      const unsigned begin = sector_of(foot_u + from * u, foot_v + from * v);
      const unsigned end = sector_of(foot_u + to * u, foot_v + to * v);
      cells |= (miss_m > 0.0 ? sectors_between(begin, end) : sectors_between(end, begin))
               << (ring * static_cast<std::size_t>(kSectors));
    };
    for (std::size_t ring = kRings; ring-- > 0;) {
      const double inner = half_chord(ring, miss_m);
      if (inner < 0.0) {
        sweep(ring, -outer, outer);
        break;
      }
      sweep(ring, -outer, -inner);
      sweep(ring, inner, outer);
      outer = inner;
    }
    return cells;
  }

 private:
  /// Half the piece of a line within a ring's inner border; negative where the line misses it.
  double half_chord(std::size_t ring, double miss_m) const {
    const double square = squares_[ring] - miss_m * miss_m;
    return square > 0.0 ? std::sqrt(square) : -1.0;
  }

  Eigen::Vector2d origin_;  // of the rays, seen from the keypoint, axes of the sensor
  Eigen::Vector2d axis_;    // the keypoint's orientation
  std::array<double, kRings + 1> squares_{};
};

BetaGrid describe_one(const Scan& scan, const Keypoint& keypoint, const BetaGridConfig& config) {
  const BetaGridCounts counts = count_beta_grid(scan, keypoint, config);
  BetaGrid grid;
  float sum = 0.0F;
  for (std::size_t k = 0; k < grid.cells.size(); ++k) {
    const int seen = counts.hits[k] + counts.misses[k];
    grid.cells[k] = seen == 0 ? 0.5F : static_cast<float>(counts.hits[k]) / static_cast<float>(seen);
    sum += grid.cells[k];
  }
  if (sum > 0.0F)
    for (float& cell : grid.cells) cell /= sum;
  else
    grid.cells.fill(1.0F / BetaGrid::kCells);
  return grid;
}

}  // namespace

void describe(Fields& fields, BetaGridConfig& config) {
  fields.section("neighbourhood", config.neighbourhood);
  fields("inner_m", config.inner_m, {0.0, 10.0}, "where the first ring begins");
  fields("margin_m", config.margin_m, {0.0, 1.0},
         "the last piece of a beam, within the noise of its wall, is not free space");
}

BetaGridCounts count_beta_grid(const Scan& scan, const Keypoint& keypoint, const BetaGridConfig& config) {
  const double radius_m = config.neighbourhood.radius_at(keypoint.point.norm());
  const PolarCells<BetaGrid::kSectors, BetaGrid::kRings> cells(keypoint, config.inner_m, radius_m, 0.0);
  const RaysAround rays(keypoint, config.inner_m, radius_m);
  BetaGridCounts counts;
  for (const ScanSegment& run : beams_around(scan, keypoint.point, radius_m).runs)
    for (std::size_t beam = run.first; beam < run.first + run.count; ++beam) {
      std::uint64_t passed = 0;
      if (scan.is_hit(beam)) {
        const double range_m = static_cast<double>(scan.ranges_m()[beam]);
        passed = rays.passed(scan.point(beam) / range_m, range_m - config.margin_m);
        const int end = cells.cell(scan.x_m()[beam], scan.y_m()[beam]);
        if (end < BetaGrid::kCells) {
          ++counts.hits[static_cast<std::size_t>(end)];
          passed &= ~(std::uint64_t{1} << static_cast<unsigned>(end));
        }
      } else if (scan.beams()[beam] == Beam::no_return) {
        passed = rays.passed(scan.direction(beam), std::numeric_limits<double>::infinity());
      }
      for (; passed != 0; passed &= passed - 1U)
        ++counts.misses[static_cast<std::size_t>(std::countr_zero(passed))];
    }
  return counts;
}

std::vector<BetaGrid> describe_beta_grid(const Scan& scan, std::span<const Keypoint> keypoints,
                                         const BetaGridConfig& config) {
  std::vector<BetaGrid> out;
  describe_beta_grid(scan, keypoints, config, out);
  return out;
}

void describe_beta_grid(const Scan& scan, std::span<const Keypoint> keypoints, const BetaGridConfig& config,
                        std::vector<BetaGrid>& out) {
  out.clear();
  out.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) out.push_back(describe_one(scan, keypoint, config));
}

}  // namespace beaconless
