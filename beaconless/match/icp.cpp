// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/icp.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "beaconless/geometry/rigid_fit.hpp"

namespace beaconless {
namespace {

constexpr double kGaussianMad = 1.4826;  // standard deviation of a Gaussian from its median absolute value
constexpr double kNear_m = 0.05;         // a closed-form step below both is near enough …
constexpr double kNear_rad = 0.02;       // … for the linearised step to be believed
constexpr double kOnWall_m = 1e-9;

using Pair = IcpScratch::Pair;

/// The partner of every point that has one. Returns the sum of |arm|², for the scale of headings.
template <SurfaceIndex Index>
double make_pairs(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& pose,
                  double max_distance_m, std::vector<Pair>& pairs) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d origin = pose.translation();
  double spread = 0.0;
  pairs.clear();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = rotation * point;
    const auto surface = map.nearest(origin + arm);
    if (!surface || surface->distance_m > max_distance_m) continue;
    const Eigen::Vector2d residual = origin + arm - surface->point;
    const bool on_wall = surface->distance_m < kOnWall_m;
    pairs.push_back({arm, residual,
                     on_wall ? surface->normal : Eigen::Vector2d(residual / surface->distance_m),
                     surface->distance_m});
    spread += arm.squaredNorm();
  }
  return spread;
}

/// The robust standard deviation of the residuals, never below what noise and map make anyway.
double robust_scale(const std::vector<Pair>& pairs, double floor_m, std::vector<double>& sorted) {
  sorted.clear();
  for (const Pair& pair : pairs) sorted.push_back(pair.distance_m);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return std::max(floor_m, kGaussianMad * *middle);
}

/// The sums a step is made of, all weighted. Jacobians are of the distance by (x, y, theta) of the laser.
struct Normal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();   // Σ w J Jᵀ
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();     // Σ w² r² J Jᵀ
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // Σ w J r
  RigidFit alignment;                                  // arms onto arms - residuals
};

template <RobustLoss Loss>
Normal weigh(const std::vector<Pair>& pairs, const Loss& loss, double scale_m) {
  Normal normal;
  const double whiten = 1.0 / (scale_m * scale_m);
  for (const Pair& pair : pairs) {
    const double square = pair.distance_m * pair.distance_m;
    const double weight = loss.weight(square * whiten);
    const Eigen::Vector3d jacobian(pair.normal.x(), pair.normal.y(),
                                   pair.normal.y() * pair.arm.x() - pair.normal.x() * pair.arm.y());
    normal.hessian += weight * jacobian * jacobian.transpose();
    normal.noise += weight * weight * square * jacobian * jacobian.transpose();
    normal.gradient += weight * pair.distance_m * jacobian;
    normal.alignment.add(pair.arm, pair.arm - pair.residual, weight);
  }
  return normal;
}

/// The eigenvectors of the Hessian with headings measured in metres at the mean arm, and which of them are
/// determined.
struct Observability {
  Eigen::Matrix3d directions;  // columns, least certain first, in (m, m, rad)
  Eigen::Vector3d hessian;     // eigenvalues
  int weak_count = 0;

  Observability(const Eigen::Matrix3d& full, double arm_m, double scale_m, double unobservable_sigma_m) {
    const Eigen::DiagonalMatrix<double, 3> to_metres(1.0, 1.0, 1.0 / arm_m);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        Eigen::Matrix3d(to_metres * full * to_metres));
    directions = to_metres * solver.eigenvectors();
    hessian = solver.eigenvalues();
    const double least = scale_m * scale_m / (unobservable_sigma_m * unobservable_sigma_m);
    while (weak_count < 3 && !(hessian[weak_count] > least)) ++weak_count;
  }

  /// H⁻¹ v along the determined directions only.
  Eigen::Matrix3d inverse() const {
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    for (int k = weak_count; k < 3; ++k)
      inverse += directions.col(k) * directions.col(k).transpose() / hessian[k];
    return inverse;
  }
};

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.theta_rad + step.z())};
}

/// The closed-form alignment as a step of the laser.
Eigen::Vector3d alignment_step(const RigidFit& alignment) {
  const auto turn = alignment.solve();
  return turn ? Eigen::Vector3d(turn->x_m, turn->y_m, turn->theta_rad) : Eigen::Vector3d::Zero();
}

double on_map_ratio(const std::vector<Pair>& pairs, std::size_t point_count, double on_map_m) {
  const auto on_map =
      std::count_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.distance_m <= on_map_m; });
  return static_cast<double>(on_map) / static_cast<double>(point_count);
}

template <SurfaceIndex Index>
MatchResult match(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& guess,
                  const IcpConfig& config, IcpScratch& scratch) {
  MatchResult result;
  result.map_from_laser = guess;
  result.status = MatchStatus::max_iterations;
  const double floor_m = std::hypot(config.sigma_m, config.map_sigma_m);

  while (result.iterations < config.max_iterations) {
    const double spread =
        make_pairs(points, map, result.map_from_laser, config.max_pair_distance_m, scratch.pairs);
    result.pair_count = static_cast<int>(scratch.pairs.size());
    if (result.pair_count < config.min_pairs) {
      MatchResult none;
      none.map_from_laser = guess;
      none.status = MatchStatus::too_few_pairs;
      none.pair_count = result.pair_count;
      none.iterations = result.iterations;
      return none;
    }
    ++result.iterations;
    result.scale_m = robust_scale(scratch.pairs, floor_m, scratch.sorted);
    const Normal normal = with_loss(config.loss, config.loss_k_sigma, [&](const auto& loss) {
      return weigh(scratch.pairs, loss, result.scale_m);
    });
    const double arm_m = std::sqrt(spread / static_cast<double>(result.pair_count)) + 1e-3;
    const Observability seen(normal.hessian, arm_m, result.scale_m, config.unobservable_sigma_m);
    const Eigen::Matrix3d inverse = seen.inverse();

    Eigen::Vector3d step = alignment_step(normal.alignment);
    const bool near = step.head<2>().norm() < kNear_m && std::abs(step.z()) < kNear_rad;
    if (near && config.solver == IcpSolver::mixed) step = -inverse * normal.gradient;
    result.map_from_laser = moved(result.map_from_laser, step);

    result.rank = 3 - seen.weak_count;
    result.weak_direction = seen.directions.col(0).normalized();
    result.covariance = inverse * normal.noise * inverse;
    for (int k = 0; k < seen.weak_count; ++k)
      result.covariance += MatchResult::kUnknownSigma * MatchResult::kUnknownSigma * seen.directions.col(k) *
                           seen.directions.col(k).transpose();
    // The map's error does not average out over the beams of a wall.
    const double map_variance = config.map_sigma_m * config.map_sigma_m;
    result.covariance.diagonal() += map_variance * Eigen::Vector3d(1.0, 1.0, 1.0 / (arm_m * arm_m));
    if (step.head<2>().norm() < config.converged_m && std::abs(step.z()) < config.converged_rad) {
      result.status = MatchStatus::converged;
      break;
    }
  }
  result.on_map_ratio = on_map_ratio(scratch.pairs, points.size(), config.on_map_m);
  return result;
}

}  // namespace

void describe(Fields& fields, IcpConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("map_sigma_m", config.map_sigma_m, {0.0, 1.0},
         "standard deviation of the map's walls; 0: none for a floor plan, that of its cells for a grid");
  fields("loss", config.loss, {"huber", "cauchy", "tukey", "welsch", "geman-mcclure"},
         "robust criterion that keeps people and clutter from pulling");
  fields("loss_k_sigma", config.loss_k_sigma, {0.0, 100.0},
         "scale of the loss in sigmas; 0: 95 % efficiency");
  fields("solver", config.solver, {"alignment", "mixed"},
         "how a step is found: the closed form alone, or Gauss-Newton once near");
  fields("max_pair_distance_m", config.max_pair_distance_m, {0.01, 10.0},
         "points further from every wall are left out");
  fields("on_map_m", config.on_map_m, {0.001, 1.0},
         "a point this near to a wall counts as explained by the map");
  fields("max_iterations", config.max_iterations, {1, 1000}, "most iterations of one match");
  fields("converged_m", config.converged_m, {1e-9, 0.1},
         "a shorter step ends the match, if it also turns little");
  fields("converged_rad", config.converged_rad, {1e-9, 0.1},
         "a smaller turn ends the match, if it also moves little");
  fields("unobservable_sigma_m", config.unobservable_sigma_m, {1e-3, 100.0},
         "a direction that the scan tells less well than this is held at the prediction");
  fields("min_pairs", config.min_pairs, {3, 100000}, "fewer points near walls make no match");
}

MatchResult match_icp(std::span<const Eigen::Vector2d> points, const WallIndex& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch) {
  return match(points, map, guess, config, scratch);
}

MatchResult match_icp(std::span<const Eigen::Vector2d> points, const CellIndex& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch) {
  return match(points, map, guess, config, scratch);
}

}  // namespace beaconless
