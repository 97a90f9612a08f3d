// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace beaconless {
namespace {

constexpr std::size_t kMostLines = 32;
constexpr std::size_t kOctants = 8;
constexpr double kSameLine_m = 0.05;  // racks and rows of uprights are one line, the two sides of a wall not
constexpr double kSameLine_sine = 0.03;
constexpr double kOff_sigma = 4.0;  // of a line, that noise explains
constexpr std::size_t kMostPaired = 12;
constexpr double kOpen_m = 0.25;  // a rest less certain than this determines no pose

/// The line on which a piece lies; the last of them where there are too many.
WallPiece& line_of(const WallPiece& piece, std::vector<WallPiece>& lines) {
  for (WallPiece& line : lines) {
    if (std::abs(line.offset_m - piece.offset_m) > kSameLine_m) continue;
    const double sine = line.nx * piece.ny - line.ny * piece.nx;
    const double cosine = line.nx * piece.nx + line.ny * piece.ny;
    if (std::abs(sine) < kSameLine_sine && cosine > 0.0) return line;
  }
  if (lines.size() < kMostLines) lines.push_back({piece.nx, piece.ny, piece.offset_m, 0, 0, {}});
  return lines.back();
}

/// The squares of how far the pose goes without each line.
struct Separations {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double tt = 0.0;

  void add(const WallRest& rest) {
    xx += rest.dx_m * rest.dx_m;
    xy += rest.dx_m * rest.dy_m;
    yy += rest.dy_m * rest.dy_m;
    tt += rest.dtheta_rad * rest.dtheta_rad;
  }
  double largest_m2() const { return largest_of(xx, xy, yy); }
};

/// The furthest so far.
class Furthest {
 public:
  explicit Furthest(double sigmas) : sigmas_(sigmas) {}

  void take(const WallRest& rest) {
    is_bounded_ = is_bounded_ && rest.is_determined;
    if (rest.way_m2() > rest_.way_m2()) rest_ = rest;
    reach(std::sqrt(rest.way_m2()), rest.variance_m2, std::abs(rest.dtheta_rad), rest.variance_rad2);
  }
  void reach(double way_m, double variance_m2, double turn_rad, double variance_rad2) {
    level_.position_m = std::max(level_.position_m, way_m + sigmas_ * std::sqrt(variance_m2));
    level_.heading_rad = std::max(level_.heading_rad, turn_rad + sigmas_ * std::sqrt(variance_rad2));
  }
  const WallRest& rest() const { return rest_; }
  ProtectionLevel level() const {
    if (!is_bounded_ || !(level_.position_m < ProtectionLevel::kUnbounded_m) || !(level_.heading_rad < kPi))
      return {};
    return level_;
  }

 private:
  double sigmas_;
  ProtectionLevel level_{0.0, 0.0};
  WallRest rest_;
  bool is_bounded_ = true;
};

/// Whether a line is off by more than noise explains.
bool is_any_off(std::span<const WallPiece> lines, const SeparatedFit& fit) {
  return std::any_of(lines.begin(), lines.end(), [&](const WallPiece& line) {
    const double pull = line.nx * line.sums.gradient[0] + line.ny * line.sums.gradient[1];
    return pull * pull > kOff_sigma * kOff_sigma * fit.variance_factor * line.sums.across();
  });
}

/// Every two lines left out together, of those that tell most; not where the pose would be open without them.
void take_pairs(const SeparatedFit& fit, const PartialSums& all, const WallPulls& pulls, double bias_m2,
                std::vector<WallPiece>& lines, Furthest& furthest) {
  const std::size_t count = std::min(lines.size(), kMostPaired);
  const auto tells_more = [](const WallPiece& a, const WallPiece& b) {
    return a.sums.across() > b.sums.across();
  };
  std::partial_sort(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(count), lines.end(),
                    tells_more);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      PartialSums both = lines[i].sums;
      both += lines[j].sums;
      WallPulls of_others = pulls;
      of_others.add(lines[i], -bias_m2);
      of_others.add(lines[j], -bias_m2);
      const WallRest rest = rest_without(all, both, of_others, fit);
      if (rest.is_determined && rest.variance_m2 < kOpen_m * kOpen_m) furthest.take(rest);
    }
  }
}

}  // namespace

Separated separate_walls(const SeparatedFit& fit, const ProtectionConfig& config,
                         std::span<const WallPiece> pieces, std::vector<WallPiece>& lines, bool is_fitted) {
  const double bias_m2 = config.bias_m * config.bias_m;
  // 1. The beams by lines and by octants.
  PartialSums all;
  std::array<PartialSums, kOctants> octants{};
  lines.clear();
  for (const WallPiece& piece : pieces) {
    if (!(piece.sums.across() > 0.0)) continue;
    all += piece.sums;
    octants[static_cast<std::size_t>(piece.octant)] += piece.sums;
    line_of(piece, lines).sums += piece.sums;
  }
  WallPulls pulls;
  for (const WallPiece& line : lines) pulls.add(line, bias_m2);
  // 2. Nothing left out, then each.
  Furthest furthest(protection_sigmas(config.risk));
  const WallRest whole = rest_without(all, {}, pulls, fit);
  furthest.take(whole);
  Separations separations;
  for (const WallPiece& line : lines) {
    WallPulls of_others = pulls;
    of_others.add(line, -bias_m2);
    const WallRest rest = rest_without(all, line.sums, of_others, fit);
    furthest.take(rest);
    separations.add(rest);
  }
  for (const PartialSums& octant : octants)
    if (octant.across() > 0.0) furthest.take(rest_without(all, octant, pulls, fit));
  // 3. What lines differ by.
  if (is_fitted)
    furthest.reach(0.0, whole.variance_m2 + separations.largest_m2(), 0.0,
                   whole.variance_rad2 + separations.tt);
  // 4. If one is off by more than noise explains, two may be.
  if (is_fitted && is_any_off(lines, fit)) take_pairs(fit, all, pulls, bias_m2, lines, furthest);
  return {furthest.level(), furthest.rest()};
}

}  // namespace beaconless
