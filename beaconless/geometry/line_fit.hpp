// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/line2.hpp"
#include "beaconless/geometry/point_moments.hpp"

namespace beaconless {

/// A line through points, and how sure it is.
struct LineFit {
  Line2 line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (alpha, rho): rad², rad m, m²
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();    ///< weighted
  double rms_m = 0.0;                                    ///< weighted, of the distances from the line
  std::size_t count = 0;                                 ///< points that it was fitted to

  /// The variance (m²) across the line of the line's place next to `point`; least at the centroid.
  double variance_at(const Eigen::Vector2d& point) const;
};

/// How a line is fitted to points.
enum class LineFitMethod : int {
  regression,  ///< least squares of y or of x, as in the dissertation
  tls,         ///< total least squares: of the distances
  ransac,      ///< best of many pairs of points, then tls on what agrees
  theil_sen,   ///< medians of slopes and offsets
};

/// How a line is fitted to points, and what the robust methods take for an outlier.
struct LineFitConfig {
  LineFitMethod method = LineFitMethod::tls;
  double sigma_m = 0.0;              ///< noise across the line; 0: what the residuals tell
  double ransac_tolerance_m = 0.03;  ///< points further from the line are outliers
  double ransac_min_base_m = 0.05;   ///< pairs nearer than this make no line
  double ransac_confidence_ratio = 0.99;
  int ransac_max_draws = 500;
  int ransac_seed = 1;
  int theil_sen_max_pairs = 100000;  ///< with more pairs than this, only every second, third … gap is used
};

void describe(Fields& fields, LineFitConfig& config);

/// Buffers that live on from fit to fit.
struct LineFitScratch {
  std::vector<double> values;
};

/// Fits a line with the method of the config. Nothing when the points have no direction: fewer than two
/// distinct ones. Cost: O(n); RANSAC O(n draws); Theil-Sen O(n²) up to its cap.
std::optional<LineFit> fit_line(std::span<const Eigen::Vector2d> points, const LineFitConfig& config,
                                LineFitScratch& scratch);
std::optional<LineFit> fit_line(std::span<const Eigen::Vector2d> points, const LineFitConfig& config = {});

/// Regression of y on x, or of x on y where the points spread more in y.
///
/// Source: dissertation 2.1.2 and Algorithm 3. Differs: Algorithm 3 compares sums instead of standard
/// deviations, the wrong way round, and inverts the slope of y on x, which mirrors the line about y = x
/// instead of regressing x on y, with an intercept that stays the old one. Biased: a slope shrinks by
/// s_xx / (s_xx + n sigma²); prefer `fit_line_tls`.
std::optional<LineFit> fit_line_regression(std::span<const Eigen::Vector2d> points, double sigma_m = 0.0);

/// Total least squares; the noise is `sigma_m` across the line, or with 0 what the residuals tell.
///
/// Source: var(alpha) = sigma²/T, cov(alpha, rho) = t̄ var(alpha), var(rho) = sigma²/n + t̄² var(alpha) with
/// the coordinates t = -x sin(alpha) + y cos(alpha), T = Σ (t - t̄)².
std::optional<LineFit> fit_line_tls(std::span<const Eigen::Vector2d> points, double sigma_m = 0.0);

/// Weighted: a point of weight w has the variance sigma_m² / w across the line. One weight a point; those
/// that are not positive leave their point out. Differs: flirtlib divides by Σ w what it weighted by 1/w².
std::optional<LineFit> fit_line_tls(std::span<const Eigen::Vector2d> points, std::span<const double> weights,
                                    double sigma_m = 0.0);

/// From sums alone, in O(1); the second where their principal line is known already.
std::optional<LineFit> fit_line_tls(const PointMoments& sums, double sigma_m = 0.0);
std::optional<LineFit> fit_line_tls(const PointMoments& sums, const PrincipalLine& line, double sigma_m);

/// The line that costs least when each point costs min(distance², tolerance²), refitted to its inliers.
///
/// Draws as many pairs as make it sure, with the confidence asked for, that one was free of outliers, by the
/// best share of inliers so far. Source: Fischler and Bolles 1981; Torr and Zisserman 2000 (MSAC);
/// dissertation Algorithm 4. Differs: there one number is both the tolerance and the least count, nothing is
/// kept to take the maximum of, pairs close together are used, the inliers are not refitted and the draws are
/// fixed.
std::optional<LineFit> fit_line_ransac(std::span<const Eigen::Vector2d> points, const LineFitConfig& config);

/// The median slope of all pairs and the median offset, along the direction of the points.
///
/// Bears 29 % outliers. Source: Theil 1950; Sen 1968; dissertation 2.1.2. Differs: slopes are taken in axes
/// turned to a robust direction of the points, since in those of the sensor a vertical line has none and the
/// fit would change as the robot turns.
std::optional<LineFit> fit_line_theil_sen(std::span<const Eigen::Vector2d> points,
                                          const LineFitConfig& config, LineFitScratch& scratch);

}  // namespace beaconless
