// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "beaconless/features/ordered_points.hpp"
#include "beaconless/geometry/line_fit.hpp"

namespace beaconless {

/// How much a beam counts in a line fit.
enum class BeamWeight : int {
  uniform,  ///< all the same: noise across the line is that of the ranges
  radial,   ///< noise is along the beams, so that of a beam that grazes the wall is small across it
};

/// Prefix sums over a scan's points: the weighted line through any run of beams in O(1).
///
/// The noise of a beam across a wall is sigma |cos b|, and the cosine of the incidence b on a line at
/// distance rho is rho/r: the weight is r²/rho², and rho is the same for the whole line. So r² is the right
/// weight whatever the line, and the sums need no second pass once it is known. Source: weighted total least
/// squares, w = 1/(sigma cos b)². Differs: elsewhere incidence is estimated and the fit repeated.
class LineSums {
 public:
  void build(const OrderedPoints& points, double sigma_m, BeamWeight weight) {
    sigma_m_ = sigma_m;
    weight_ = weight;
    sums_.resize(points.size());
    Sum sum;
    double least = 0.0;  // of the squared ranges that may join the stretch
    double most = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points.x_m[i];
      const double y = points.y_m[i];
      const double square = x * x + y * y;
      const double hit = points.ranges_m[i] > 0.0F ? 1.0 : 0.0;
      if (i == 0 || (hit > 0.0 && !(square >= least && square <= most))) {
        sum = {.start = i};
        least = square / kStretch;
        most = square * kStretch;
      }
      sum.moments.add(x, y, weight == BeamWeight::radial ? square : hit);
      sum.moments.count -= 1.0 - hit;
      sums_[i] = sum;
    }
  }

  /// Of the hits at the places `first` … `last`, both included.
  PointMoments of(std::size_t first, std::size_t last) const {
    PointMoments sum = sums_[last].moments;
    std::size_t start = sums_[last].start;
    for (; start > first; start = sums_[start - 1].start) sum = sum + sums_[start - 1].moments;
    return start == first ? sum : sum - sums_[first - 1].moments;
  }

  /// The noise (m) across the line of a beam whose weight is one.
  double unit_sigma_m(const PrincipalLine& line, const PointMoments& sums) const {
    if (weight_ == BeamWeight::uniform) return sigma_m_;
    return sigma_m_ *
           std::sqrt(line.rho_m * line.rho_m + kLeastCosine * kLeastCosine * sums.weight / sums.count);
  }

  /// Squared distances from the best line, in units of their variance: count - 2 on average. As
  /// principal_line, but without its normal: of that, rho² needs the doubled angle only.
  double chi_square(const PointMoments& sums) const {
    if (!(sums.weight > 0.0)) return 0.0;
    const double inverse = 1.0 / sums.weight;
    const double x = sums.x * inverse;
    const double y = sums.y * inverse;
    const double xx = std::max(0.0, sums.xx - sums.x * x);
    const double yy = std::max(0.0, sums.yy - sums.y * y);
    const double xy = sums.xy - sums.x * y;
    const double root = std::sqrt((yy - xx) * (yy - xx) + 4.0 * xy * xy);
    const double along = 0.5 * (xx + yy + root);
    if (!(along > 0.0 && root > 0.0)) return 0.0;
    double variance = sigma_m_ * sigma_m_;
    if (weight_ == BeamWeight::radial) {
      const double turned = ((yy - xx) * (x * x - y * y) - 4.0 * xy * x * y) / root;
      const double rho_square = std::max(0.0, 0.5 * (x * x + y * y + turned));
      variance *= rho_square + kLeastCosine * kLeastCosine * sums.weight / sums.count;
    }
    return std::max(0.0, xx * yy - xy * xy) / (along * variance);
  }

  double sigma_m() const { return sigma_m_; }

 private:
  // Bearings jitter and spots are wide: no beam is as good across a wall that it grazes as the cosine says.
  static constexpr double kLeastCosine = 0.1;

  // Terms grow with the fourth power of the range: a far wall in the sum would leave nothing of a near one's
  // digits. So a sum begins anew where ranges have doubled or halved, and those of several stretches add up.
  static constexpr double kStretch = 4.0;

  /// Of all places from `start` on.
  struct Sum {
    PointMoments moments;
    std::size_t start = 0;
  };

  double sigma_m_ = 0.0;
  BeamWeight weight_ = BeamWeight::radial;
  std::vector<Sum> sums_;
};

}  // namespace beaconless
