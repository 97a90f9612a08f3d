// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

namespace beaconless {

/// Weighted sums of points up to second order: all that a least-squares line needs to know of them.
///
/// Sums of parts add up to those of the whole, and a difference of two prefix sums is that of the points
/// between, so the line through any interval of a scan costs O(1). A difference has only the digits that the
/// larger sum leaves: points of very different magnitude want sums of their own.
struct PointMoments {
  double count = 0.0;
  double weight = 0.0;
  double x = 0.0, y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double x_m, double y_m, double w = 1.0) {
    count += 1.0;
    weight += w;
    x += w * x_m;
    y += w * y_m;
    xx += w * x_m * x_m;
    xy += w * x_m * y_m;
    yy += w * y_m * y_m;
  }

  friend PointMoments operator+(const PointMoments& p, const PointMoments& q) {
    return {p.count + q.count, p.weight + q.weight, p.x + q.x,  p.y + q.y,
            p.xx + q.xx,       p.xy + q.xy,         p.yy + q.yy};
  }
  friend PointMoments operator-(const PointMoments& p, const PointMoments& q) {
    return {p.count - q.count, p.weight - q.weight, p.x - q.x,  p.y - q.y,
            p.xx - q.xx,       p.xy - q.xy,         p.yy - q.yy};
  }
};

/// The principal axes of some points: the total least-squares line through them, without its angle.
struct PrincipalLine {
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double rho_m = 0.0;          ///< may be negative: the normal is not turned away from the origin
  double across_square = 0.0;  ///< weighted sum of squared distances from the line, m²
  double along_square = 0.0;   ///< … of squared distances from the centroid along it, m²

  double signed_distance_m(const Eigen::Vector2d& point) const { return normal.dot(point) - rho_m; }
  Eigen::Vector2d along() const { return {-normal.y(), normal.x()}; }
};

/// The line with the least weighted sum of squared distances from the points.
///
/// All points equal, or none: a line through them (or the origin) with `along_square` 0. Cost: three square
/// roots. Source: the eigenvectors of [s_xx s_xy; s_xy s_yy], tan 2a = -2 s_xy / (s_yy - s_xx), with the half
/// angle taken from its cosine. Differs: the smaller eigenvalue comes from the determinant, which keeps it
/// exact where the usual difference of the trace and the root cancels.
inline PrincipalLine principal_line(const PointMoments& sums) {
  PrincipalLine line;
  if (!(sums.weight > 0.0)) return line;
  const double inverse = 1.0 / sums.weight;
  line.centroid = {sums.x * inverse, sums.y * inverse};
  const double xx = std::fmax(0.0, sums.xx - sums.x * line.centroid.x());
  const double yy = std::fmax(0.0, sums.yy - sums.y * line.centroid.y());
  const double xy = sums.xy - sums.x * line.centroid.y();
  const double difference = yy - xx;
  const double root = std::sqrt(difference * difference + 4.0 * xy * xy);
  if (root > 0.0) {
    const double cosine = difference / root;  // of the normal's angle, doubled
    const double sine = -2.0 * xy / root;
    const double larger = std::sqrt(0.5 * (1.0 + std::fabs(cosine)));
    const double smaller = 0.5 * sine / larger;
    if (cosine >= 0.0)
      line.normal = {larger, smaller};
    else
      line.normal = {smaller, larger};
  }
  line.rho_m = line.normal.dot(line.centroid);
  line.along_square = 0.5 * (xx + yy + root);
  if (line.along_square > 0.0) line.across_square = std::fmax(0.0, (xx * yy - xy * xy) / line.along_square);
  return line;
}

/// Where two lines cross; nothing when the sine of the angle between them is not above `min_sine`.
inline std::optional<Eigen::Vector2d> crossing(const PrincipalLine& p, const PrincipalLine& q,
                                               double min_sine) {
  const double sine = p.normal.x() * q.normal.y() - p.normal.y() * q.normal.x();
  if (!(std::abs(sine) > min_sine)) return std::nullopt;
  return Eigen::Vector2d{(p.rho_m * q.normal.y() - q.rho_m * p.normal.y()) / sine,
                         (q.rho_m * p.normal.x() - p.rho_m * q.normal.x()) / sine};
}

}  // namespace beaconless
