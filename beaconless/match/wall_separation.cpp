// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace beaconless {
namespace {

constexpr std::size_t kMostLines = 32;
constexpr double kSameLine_m = 0.05;  // racks and rows of uprights are one line, the two sides of a wall not
constexpr double kSameLine_sine = 0.03;
constexpr double kPlainly_sigma = 4.0;  // of a piece's mean, and …
constexpr double kPlainly_m = 0.01;     // … so far from its wall
constexpr std::size_t kOctants = 8;

struct Symmetric3 {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xt = 0.0;
  double yt = 0.0;
  double tt = 0.0;
};

/// What a line that is off by a metre moves the gradient by.
std::array<double, 3> pull_of(const WallPiece& line) {
  const double along = line.nx * line.nx > line.ny * line.ny ? line.sums.hessian[3] / line.nx
                                                             : line.sums.hessian[4] / line.ny;
  return {line.nx * line.sums.across, line.ny * line.sums.across, along};
}

void add_square(Symmetric3& to, const std::array<double, 3>& v, double factor) {
  to.xx += factor * v[0] * v[0];
  to.xy += factor * v[0] * v[1];
  to.yy += factor * v[1] * v[1];
  to.xt += factor * v[0] * v[2];
  to.yt += factor * v[1] * v[2];
  to.tt += factor * v[2] * v[2];
}

double largest_of(double xx, double xy, double yy) {
  const double half = 0.5 * (xx - yy);
  return 0.5 * (xx + yy) + std::sqrt(half * half + xy * xy);
}

/// Where the pose goes without some beams, and how uncertain it is there.
struct Rest {
  bool is_determined = false;
  double dx = 0.0;
  double dy = 0.0;
  double dt = 0.0;
  double variance_m2 = 0.0;  // along the worst direction
  double variance_rad2 = 0.0;
};

class Separation {
 public:
  Separation(const SeparatedFit& fit, const ProtectionConfig& config, SeparationScratch& scratch)
      : fit_(fit),
        sigmas_(protection_sigmas(config.risk)),
        bias_m2_(config.bias_m * config.bias_m),
        scratch_(scratch) {
    scratch.lines.clear();
    for (const WallPiece& piece : scratch.pieces) {
      whole_ += piece.sums;
      octants_[static_cast<std::size_t>(piece.octant)] += piece.sums;
      line_of(piece).sums += piece.sums;
      if (const double z2 = z2_of(piece); z2 > 0.0) {
        beside_ += piece.sums;
        const bool is_short = is_short_of_wall(piece);
        if (is_short) short_ += piece.sums;
      }
    }
    for (const WallPiece& line : scratch.lines) add_square(pulls_, pull_of(line), bias_m2_);
  }

  ProtectionLevel level() {
    take(rest_without({}, {}));
    for (const WallPiece& line : scratch_.lines) {
      Symmetric3 own;
      add_square(own, pull_of(line), bias_m2_);
      const Rest rest = rest_without(line.sums, own);
      take(rest);
      jack_xx_ += rest.dx * rest.dx;
      jack_xy_ += rest.dx * rest.dy;
      jack_yy_ += rest.dy * rest.dy;
      jack_tt_ += rest.dt * rest.dt;
    }
    for (std::size_t i = 0; i < kOctants; ++i) {
      if (octants_[i].across == 0.0) continue;
      take(rest_without(octants_[i], {}));
      for (std::size_t j = i + 1; j < kOctants; ++j) {
        if (octants_[j].across == 0.0) continue;
        PartialSums both = octants_[i];
        both += octants_[j];
        take(rest_without(both, {}));
      }
    }
    if (short_.across > 0.0) take(rest_without(short_, {}));
    if (beside_.across > 0.0) take(rest_without(beside_, {}));
    if (!is_bounded_) return {};
    const Rest all = rest_without({}, {});
    level_.position_m = std::max(
        level_.position_m, sigmas_ * std::sqrt(largest_of(jack_xx_, jack_xy_, jack_yy_) + all.variance_m2));
    level_.heading_rad =
        std::max(level_.heading_rad, sigmas_ * std::sqrt(jack_tt_ + all.variance_rad2));
    if (!(level_.position_m < ProtectionLevel::kUnbounded_m)) return {};
    level_.heading_rad = std::min(level_.heading_rad, kPi);
    return level_;
  }

 private:
  WallPiece& line_of(const WallPiece& piece) {
    auto& lines = scratch_.lines;
    for (WallPiece& line : lines) {
      const bool is_same = std::abs(line.nx * piece.ny - line.ny * piece.nx) < kSameLine_sine &&
                           line.nx * piece.nx + line.ny * piece.ny > 0.0 &&
                           std::abs(line.offset_m - piece.offset_m) < kSameLine_m;
      if (is_same) return line;
    }
    if (lines.size() < kMostLines) lines.push_back({piece.nx, piece.ny, piece.offset_m, 0, {}});
    return lines.back();
  }

  static double mean_of(const WallPiece& piece) {
    return (piece.nx * piece.sums.gradient[0] + piece.ny * piece.sums.gradient[1]) / piece.sums.across;
  }
  double z2_of(const WallPiece& piece) const {
    const double mean = mean_of(piece);
    const double z2 = mean * mean * piece.sums.across / fit_.variance_factor;
    return z2 > kPlainly_sigma * kPlainly_sigma && std::abs(mean) > kPlainly_m ? z2 : 0.0;
  }
  static bool is_short_of_wall(const WallPiece& piece) { return mean_of(piece) < 0.0; }

  Rest rest_without(const PartialSums& left_out, const Symmetric3& pulls_left_out) const {
    std::array<double, 6> h{};
    for (std::size_t i = 0; i < 6; ++i) h[i] = whole_.hessian[i] - left_out.hessian[i];
    const auto [xx, xy, yy, xt, yt, tt] = h;
    const double cxx = yy * tt - yt * yt;
    const double cxy = xt * yt - xy * tt;
    const double cyy = xx * tt - xt * xt;
    const double cxt = xy * yt - xt * yy;
    const double cyt = xy * xt - xx * yt;
    const double ctt = xx * yy - xy * xy;
    const double det = xx * cxx + xy * cxy + xt * cxt;
    Rest rest;
    if (!(det > 0.0 && cxx > 0.0 && cyy > 0.0 && ctt > 0.0)) return rest;
    rest.is_determined = true;
    const double inverse = 1.0 / det;
    const double ixx = cxx * inverse;
    const double ixy = cxy * inverse;
    const double iyy = cyy * inverse;
    const double ixt = cxt * inverse;
    const double iyt = cyt * inverse;
    const double itt = ctt * inverse;
    // The gradient of the rest, which the whole's balances but for what the last step left.
    const double gx = left_out.gradient[0];
    const double gy = left_out.gradient[1];
    const double gt = left_out.gradient[2];
    const double full = 1.0 / fit_.curvature;
    rest.dx = full * (ixx * gx + ixy * gy + ixt * gt);
    rest.dy = full * (ixy * gx + iyy * gy + iyt * gt);
    rest.dt = full * (ixt * gx + iyt * gy + itt * gt);
    // Noise, what walls are off by each, what they are off by all.
    const double mxx = pulls_.xx - pulls_left_out.xx;
    const double mxy = pulls_.xy - pulls_left_out.xy;
    const double myy = pulls_.yy - pulls_left_out.yy;
    const double mxt = pulls_.xt - pulls_left_out.xt;
    const double myt = pulls_.yt - pulls_left_out.yt;
    const double mtt = pulls_.tt - pulls_left_out.tt;
    const double px = mxx * ixx + mxy * ixy + mxt * ixt;
    const double py = mxy * ixx + myy * ixy + myt * ixt;
    const double pt = mxt * ixx + myt * ixy + mtt * ixt;
    const double qx = mxx * ixy + mxy * iyy + mxt * iyt;
    const double qy = mxy * ixy + myy * iyy + myt * iyt;
    const double qt = mxt * ixy + myt * iyy + mtt * iyt;
    const double rx = mxx * ixt + mxy * iyt + mxt * itt;
    const double ry = mxy * ixt + myy * iyt + myt * itt;
    const double rt = mxt * ixt + myt * iyt + mtt * itt;
    const double v = fit_.variance_factor;
    const double vxx = v * ixx + ixx * px + ixy * py + ixt * pt;
    const double vxy = v * ixy + ixx * qx + ixy * qy + ixt * qt;
    const double vyy = v * iyy + ixy * qx + iyy * qy + iyt * qt;
    const double vtt = v * itt + ixt * rx + iyt * ry + itt * rt;
    const double map_m2 = fit_.map_sigma_m * fit_.map_sigma_m;
    rest.variance_m2 = largest_of(vxx, vxy, vyy) + map_m2;
    rest.variance_rad2 = vtt + map_m2 / (fit_.arm_m * fit_.arm_m);
    return rest;
  }

  void take(const Rest& rest) {
    is_bounded_ = is_bounded_ && rest.is_determined;
    level_.position_m =
        std::max(level_.position_m, std::sqrt(rest.dx * rest.dx + rest.dy * rest.dy) +
                                        sigmas_ * std::sqrt(std::max(0.0, rest.variance_m2)));
    level_.heading_rad = std::max(level_.heading_rad,
                                  std::abs(rest.dt) + sigmas_ * std::sqrt(std::max(0.0, rest.variance_rad2)));
  }

  const SeparatedFit& fit_;
  double sigmas_;
  double bias_m2_;
  SeparationScratch& scratch_;
  PartialSums whole_;
  std::array<PartialSums, kOctants> octants_{};
  PartialSums short_;
  PartialSums beside_;
  Symmetric3 pulls_;  // of all lines, in squares
  double jack_xx_ = 0.0;
  double jack_xy_ = 0.0;
  double jack_yy_ = 0.0;
  double jack_tt_ = 0.0;
  bool is_bounded_ = true;
  ProtectionLevel level_{0.0, 0.0};
};

}  // namespace

ProtectionLevel separate_walls(const SeparatedFit& fit, const ProtectionConfig& config,
                               SeparationScratch& scratch) {
  return Separation(fit, config, scratch).level();
}

}  // namespace beaconless
