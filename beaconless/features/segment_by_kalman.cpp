// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/segment_by_kalman.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/features/segment_runs.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// A wall as seen from beam to beam: u = 1/r and its slope du/dθ, with their covariance.
class WallFilter {
 public:
  WallFilter(const KalmanSegmentationConfig& config, double step_rad)
      : sigma_m_(config.sigma_m),
        bend_rad_(config.bend_rad),
        // The first step may be as steep as that of the flattest wall, gate included.
        steepest_(1.0 / (std::tan(radians(config.least_incidence_deg)) * std::sqrt(config.gate_chi_square))),
        cosine_(std::cos(step_rad)),
        sine_(std::sin(step_rad)) {}

  void start(double range_m) {
    u_ = 1.0 / range_m;
    slope_ = 0.0;
    uu_ = variance_of(range_m);
    us_ = 0.0;
    ss_ = u_ * u_ * steepest_ * steepest_;
  }

  /// On to the next beam: a turn of (u, slope), and a little room for a bend.
  void predict() {
    const double u = cosine_ * u_ + sine_ * slope_;
    const double slope = cosine_ * slope_ - sine_ * u_;
    const double uu = cosine_ * cosine_ * uu_ + 2.0 * cosine_ * sine_ * us_ + sine_ * sine_ * ss_;
    const double ss = sine_ * sine_ * uu_ - 2.0 * cosine_ * sine_ * us_ + cosine_ * cosine_ * ss_;
    us_ = cosine_ * sine_ * (ss_ - uu_) + (cosine_ * cosine_ - sine_ * sine_) * us_;
    u_ = u;
    slope_ = slope;
    uu_ = uu;
    const double turn = bend_rad_ * std::hypot(u, slope);
    ss_ = ss + turn * turn;
  }

  /// The squared innovation of a range in units of its variance.
  double surprise(double range_m) const {
    const double innovation = 1.0 / range_m - u_;
    return innovation * innovation / (uu_ + variance_of(range_m));
  }

  void correct(double range_m) {
    const double innovation = 1.0 / range_m - u_;
    const double total = uu_ + variance_of(range_m);
    const double gain_u = uu_ / total;
    const double gain_s = us_ / total;
    u_ += gain_u * innovation;
    slope_ += gain_s * innovation;
    ss_ -= gain_s * us_;
    us_ -= gain_u * us_;
    uu_ -= gain_u * uu_;
  }

 private:
  /// Of 1/r for the range noise: d(1/r) = -dr/r².
  double variance_of(double range_m) const {
    const double sigma = sigma_m_ / (range_m * range_m);
    return sigma * sigma;
  }

  double sigma_m_;
  double bend_rad_;
  double steepest_;
  double cosine_;
  double sine_;
  double u_ = 0.0;
  double slope_ = 0.0;
  double uu_ = 0.0;
  double us_ = 0.0;
  double ss_ = 0.0;
};

/// Where the filter starts: beam 0; on a full circle a beam that is the same however the sensor is turned.
std::size_t start_beam(const Scan& scan) {
  if (!scan.is_full_circle()) return 0;
  const auto ranges = scan.ranges_m();
  const auto none = std::find(ranges.begin(), ranges.end(), 0.0F);
  const auto at = none != ranges.end() ? none : std::max_element(ranges.begin(), ranges.end());
  return static_cast<std::size_t>(at - ranges.begin());
}

}  // namespace

void describe(Fields& fields, KalmanSegmentationConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("gate_chi_square", config.gate_chi_square, {0.1, 1e6},
         "squared innovation, in units of its variance, above which a segment ends");
  fields("bend_rad", config.bend_rad, {0.0, 1.0}, "by how much a wall may turn from beam to beam");
  fields("least_incidence_deg", config.least_incidence_deg, {0.1, 89.0},
         "angle at which a wall may be met of which nothing is known");
  fields("min_beams", config.min_beams, {1, 1000000}, "segments of fewer beams are left out");
}

void segment_by_kalman(const Scan& scan, const KalmanSegmentationConfig& config,
                       KalmanSegmentationScratch& scratch, std::vector<ScanSegment>& segments) {
  const std::size_t n = scan.size();
  scratch.breaks.assign(n, 1);
  WallFilter wall(config, scan.angle_increment_rad());
  const std::size_t start = start_beam(scan);
  bool is_on_wall = false;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t beam = (start + k) % n;
    if (!scan.is_hit(beam)) {
      is_on_wall = false;
      continue;
    }
    const double range = scan.ranges_m()[beam];
    if (is_on_wall) {
      wall.predict();
      is_on_wall = wall.surprise(range) <= config.gate_chi_square;
    }
    if (is_on_wall) {
      wall.correct(range);
      scratch.breaks[(beam + n - 1) % n] = 0;
    } else {
      wall.start(range);
      is_on_wall = true;
    }
  }
  segments_from_breaks(scan, scratch.breaks, static_cast<std::size_t>(std::max(1, config.min_beams)),
                       segments);
}

std::vector<ScanSegment> segment_by_kalman(const Scan& scan, const KalmanSegmentationConfig& config) {
  KalmanSegmentationScratch scratch;
  std::vector<ScanSegment> segments;
  segment_by_kalman(scan, config, scratch, segments);
  return segments;
}

}  // namespace beaconless
