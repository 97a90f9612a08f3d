// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/icp.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/rigid_fit.hpp"
#include "beaconless/match/observability.hpp"

namespace beaconless {
namespace {

constexpr double kGaussianMad = 1.4826;  // standard deviation of a Gaussian from its median absolute value
constexpr double kNear_m = 0.01;         // a closed-form step below both is near enough …
constexpr double kNear_rad = 0.005;      // … for the linearised step to be believed
constexpr double kOnWall_m = 1e-9;
constexpr double kCommonNoise = 0.1;  // share of a residual's variance that is taken from all of them
constexpr double kLeastNoise = 0.25;  // share of the squared scale that is taken even where all points fit
constexpr int kPatience = 4;          // iterations without a better fit

using Pair = IcpScratch::Pair;

/// The partners of a scan's points at one pose, and what they say about the fit.
struct Pairing {
  double arm_m = 0.0;  // root mean square distance of the paired points from the laser
  double on_map_ratio = 0.0;
  double misfit = 1.0;
};

/// Finds the partner of every point that has one within `gate_m`.
template <SurfaceIndex Index>
Pairing make_pairs(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& pose,
                   double gate_m, double on_map_m, std::vector<Pair>& pairs) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d origin = pose.translation();
  double spread = 0.0;
  double fit = 0.0;
  int on_map = 0;
  pairs.clear();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = rotation * point;
    const auto surface = map.nearest(origin + arm);
    if (!surface) continue;
    if (surface->distance_m <= on_map_m) {
      const double share = surface->distance_m / on_map_m;
      fit += 1.0 - share * share;
      ++on_map;
    }
    if (surface->distance_m > gate_m) continue;
    const Eigen::Vector2d residual = origin + arm - surface->point;
    const bool on_wall = surface->distance_m < kOnWall_m;
    pairs.push_back({arm, residual,
                     on_wall ? surface->normal : Eigen::Vector2d(residual / surface->distance_m),
                     surface->distance_m});
    spread += arm.squaredNorm();
  }
  const double all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return {std::sqrt(spread / static_cast<double>(std::max<std::size_t>(pairs.size(), 1))) + 1e-3,
          on_map / all, 1.0 - fit / all};
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
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();    // Σ w² J Jᵀ
  double square_weight = 0.0;                          // Σ w²
  double square = 0.0;                                 // Σ w² r²
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // Σ w J r
  double weight = 0.0;                                 // Σ w
  double curvature = 0.0;                              // Σ rho''
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
    const Eigen::Matrix3d outer = jacobian * jacobian.transpose();
    normal.hessian += weight * outer;
    normal.noise += weight * weight * square * outer;
    normal.spread += weight * weight * outer;
    normal.square_weight += weight * weight;
    normal.square += weight * weight * square;
    normal.gradient += weight * pair.distance_m * jacobian;
    normal.weight += weight;
    normal.curvature += loss.curvature(square * whiten);
    normal.alignment.add(pair.arm, pair.arm - pair.residual, weight);
  }
  return normal;
}

/// The closed-form alignment as a step of the laser.
Eigen::Vector3d alignment_step(const RigidFit& alignment) {
  const auto turn = alignment.solve();
  return turn ? Eigen::Vector3d(turn->x_m, turn->y_m, turn->theta_rad) : Eigen::Vector3d::Zero();
}

/// The covariance of a robust estimate from the residuals it met: H⁻¹ (Σ w² r² J Jᵀ) H⁻¹, where H has the
/// curvature of the loss in the place of its weight. Source: Huber, "Robust Statistics", 1981, 6.3; White, "A
/// heteroskedasticity-consistent covariance matrix", 1980.
Eigen::Matrix3d sandwich(const Normal& normal, const Observability& seen, double arm_m, double scale_m,
                         double map_sigma_m) {
  const double bread = std::clamp(normal.curvature / normal.weight, 0.2, 1.0);
  const Eigen::Matrix3d inverse = seen.inverse() / bread;
  // A direction that one or two points hold fits them exactly: their residuals alone would call it certain.
  const double usual =
      std::max(normal.square / std::max(normal.square_weight, 1e-12), kLeastNoise * scale_m * scale_m);
  const Eigen::Matrix3d noise = (1.0 - kCommonNoise) * normal.noise + kCommonNoise * usual * normal.spread;
  Eigen::Matrix3d covariance = inverse * noise * inverse;
  covariance += seen.unknown();
  // The map's error does not average out over the beams of a wall.
  covariance.diagonal() += map_sigma_m * map_sigma_m * Eigen::Vector3d(1.0, 1.0, 1.0 / (arm_m * arm_m));
  return covariance;
}

MatchResult too_few_pairs(const Pose2& guess, int pair_count, int iterations) {
  MatchResult none;
  none.map_from_laser = guess;
  none.status = MatchStatus::too_few_pairs;
  none.pair_count = pair_count;
  none.iterations = iterations;
  return none;
}

template <SurfaceIndex Index>
MatchResult match(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& guess,
                  const IcpConfig& config, IcpScratch& scratch) {
  const double floor_m = std::hypot(config.sigma_m, config.map_sigma_m);
  MatchResult best;
  Pose2 pose = guess;
  double gate_m = config.max_pair_distance_m;
  int worse_in_a_row = 0;

  for (int iteration = 1; iteration <= config.max_iterations; ++iteration) {
    // 1. Pair the points with the map, 2. weigh the pairs by what is usual among them.
    const Pairing pairing = make_pairs(points, map, pose, gate_m, config.on_map_m, scratch.pairs);
    const int pair_count = static_cast<int>(scratch.pairs.size());
    if (pair_count < config.min_pairs) {
      if (best.status == MatchStatus::not_run) return too_few_pairs(guess, pair_count, iteration);
      break;
    }
    const double scale_m = robust_scale(scratch.pairs, floor_m, scratch.sorted);
    const Normal normal = with_loss(config.loss, config.loss_k_sigma,
                                    [&](const auto& loss) { return weigh(scratch.pairs, loss, scale_m); });
    const Observability seen(normal.hessian, pairing.arm_m, scale_m, config.unobservable_sigma_m);

    // 3. Keep the best pose met; where nearest partners alternate, no step is ever the last.
    if (best.status == MatchStatus::not_run || pairing.misfit < best.misfit) {
      worse_in_a_row = 0;
      best.map_from_laser = pose;
      best.covariance = sandwich(normal, seen, pairing.arm_m, scale_m, config.map_sigma_m);
      best.status = MatchStatus::max_iterations;
      best.rank = 3 - seen.weak_count;
      best.weak_direction = seen.directions.col(0).normalized();
      best.pair_count = pair_count;
      best.scale_m = scale_m;
      best.on_map_ratio = pairing.on_map_ratio;
      best.misfit = pairing.misfit;
    } else if (++worse_in_a_row >= kPatience) {
      best.status = MatchStatus::converged;
      break;
    }
    best.iterations = iteration;

    // 4. Step: the closed form far away, Gauss-Newton near by.
    Eigen::Vector3d step = seen.determined(alignment_step(normal.alignment));
    const bool near = step.head<2>().norm() < kNear_m && std::abs(step.z()) < kNear_rad;
    if (near && config.solver == IcpSolver::mixed) step = -seen.inverse() * normal.gradient;
    if (near) gate_m = std::min(config.max_pair_distance_m, config.gate_sigma * scale_m);
    pose = stepped(pose, step);
    if (step.head<2>().norm() < config.converged_m && std::abs(step.z()) < config.converged_rad) {
      best.map_from_laser = pose;
      best.status = MatchStatus::converged;
      break;
    }
  }
  return best;
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
  fields("gate_sigma", config.gate_sigma, {2.0, 1000.0},
         "once near, pairs this many robust sigmas apart are dropped");
  fields("on_map_m", config.on_map_m, {0.001, 1.0},
         "a point this near to a wall counts as explained by the map; unless chosen, two cells of a coarse "
         "grid");
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

MatchResult match_icp(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch) {
  return std::visit([&](const auto& index) { return match(points, index, guess, config, scratch); }, map);
}

}  // namespace beaconless
