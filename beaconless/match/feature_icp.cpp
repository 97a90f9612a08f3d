// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_icp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/rigid_fit.hpp"
#include "beaconless/match/observability.hpp"

namespace beaconless {
namespace {

constexpr double kMedianInPlane = 1.1774;  // median length of a Gaussian vector with sigma 1 on each axis
constexpr double kNear_m = 0.02;           // a step below both means that the partners will stay …
constexpr double kNear_rad = 0.005;        // … so that far ones can be dropped
constexpr double kFar = std::numeric_limits<double>::infinity();

using Pair = FeatureIcpPair;

bool are_alike(const PointFeature& seen, const PointFeature& mapped, double turn_rad,
               const FeatureIcpConfig& config) {
  if (std::abs(wrap_angle(seen.orientation_rad + turn_rad - mapped.orientation_rad)) >
      radians(config.max_turn_deg))
    return false;
  const bool told = seen.opening_rad > 0.0 && mapped.opening_rad > 0.0;
  return !told || std::abs(seen.opening_rad - mapped.opening_rad) <= radians(config.max_opening_deg);
}

/// Lists every pair within the gates, then keeps those that are each other's nearest.
void make_pairs(std::span<const PointFeature> seen, const FeatureMap& map, const Pose2& pose, bool is_near,
                const FeatureIcpConfig& config, double scale, FeatureIcpScratch& scratch) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const double floor_m2 = config.least_sigma_m * config.least_sigma_m;
  scratch.candidates.clear();
  scratch.nearest_of_seen.assign(seen.size(), kFar);
  scratch.nearest_of_mapped.assign(map.features.size(), kFar);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector2d arm = rotation * seen[i].point;
    const Eigen::Vector2d place = pose.translation() + arm;
    if (!place.allFinite()) continue;
    map.places.for_each_within(place, config.max_pair_distance_m, [&](std::size_t j) {
      const PointFeature& mapped = map.features[j];
      if (!are_alike(seen[i], mapped, pose.theta_rad, config)) return;
      Pair pair{.seen = i, .mapped = j, .arm = arm, .residual = place - mapped.point};
      const Eigen::Matrix2d spread = rotation * seen[i].covariance * rotation.transpose() +
                                     mapped.covariance + floor_m2 * Eigen::Matrix2d::Identity();
      pair.information = spread.inverse();
      pair.sigmas = std::sqrt(std::max(0.0, pair.residual.dot(pair.information * pair.residual)));
      if (is_near && pair.sigmas > config.gate_sigma * scale) return;
      // Nearest in metres: far from the solution a vague feature must not win by its vagueness.
      const double distance_m = pair.residual.norm();
      scratch.nearest_of_seen[i] = std::min(scratch.nearest_of_seen[i], distance_m);
      scratch.nearest_of_mapped[j] = std::min(scratch.nearest_of_mapped[j], distance_m);
      scratch.candidates.push_back(pair);
    });
  }
  scratch.pairs.clear();
  for (const Pair& pair : scratch.candidates) {
    const double distance_m = pair.residual.norm();
    if (distance_m <= scratch.nearest_of_seen[pair.seen] &&
        distance_m <= scratch.nearest_of_mapped[pair.mapped])
      scratch.pairs.push_back(pair);
  }
}

/// What the whitened residuals are usually like, never below what the covariances say.
double robust_scale(FeatureIcpScratch& scratch) {
  scratch.sorted.clear();
  for (const Pair& pair : scratch.pairs) scratch.sorted.push_back(pair.sigmas);
  const auto middle = scratch.sorted.begin() + static_cast<std::ptrdiff_t>(scratch.sorted.size() / 2);
  std::nth_element(scratch.sorted.begin(), middle, scratch.sorted.end());
  return std::max(1.0, *middle / kMedianInPlane);
}

/// The sums a step is made of, whitened and weighted.
struct Normal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  RigidFit alignment;  // arms onto arms - residuals
  double weight = 0.0;
  double squares = 0.0;  // Σ w sigmas²
  double arm_m = 0.0;    // root mean square
};

template <RobustLoss Loss>
Normal weigh(std::vector<Pair>& pairs, const Loss& loss, double scale) {
  Normal normal;
  for (Pair& pair : pairs) {
    const double squared = pair.sigmas * pair.sigmas;
    pair.weight = loss.weight(squared / (scale * scale));
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian << 1.0, 0.0, -pair.arm.y(), 0.0, 1.0, pair.arm.x();
    const Eigen::Matrix<double, 3, 2> whitened = pair.weight * jacobian.transpose() * pair.information;
    normal.hessian += whitened * jacobian;
    normal.gradient += whitened * pair.residual;
    normal.alignment.add(pair.arm, pair.arm - pair.residual, pair.weight * pair.information.trace());
    normal.weight += pair.weight;
    normal.squares += pair.weight * squared;
    normal.arm_m += pair.arm.squaredNorm();
  }
  normal.arm_m = std::sqrt(normal.arm_m / static_cast<double>(pairs.size())) + 1e-3;
  return normal;
}

/// Two equations a pair, three unknowns.
double excess_variance(const Normal& normal) {
  const double freedom = 2.0 * normal.weight - 3.0;
  return freedom > 0.0 ? std::max(1.0, normal.squares / freedom) : 1.0;
}

}  // namespace

void describe(Fields& fields, FeatureIcpConfig& config) {
  fields("loss", config.loss, {"huber", "cauchy", "tukey", "welsch", "geman-mcclure"},
         "robust criterion that keeps wrong pairs from pulling");
  fields("loss_k_sigma", config.loss_k_sigma, {0.0, 100.0},
         "scale of the loss in sigmas; 0: 95 % efficiency");
  fields("max_pair_distance_m", config.max_pair_distance_m, {0.01, 10.0},
         "features further apart are never the same");
  fields("max_turn_deg", config.max_turn_deg, {0.0, 180.0},
         "nor those whose orientations differ by more than this");
  fields("max_opening_deg", config.max_opening_deg, {0.0, 180.0},
         "nor corners whose walls meet at angles that differ by more than this");
  fields("gate_sigma", config.gate_sigma, {1.0, 1000.0},
         "once near, pairs this many standard deviations apart are dropped");
  fields("least_sigma_m", config.least_sigma_m, {1e-6, 1.0}, "no feature is placed better than this");
  fields("min_pairs", config.min_pairs, {2, 1000}, "fewer pairs make no match");
  fields("max_iterations", config.max_iterations, {1, 1000}, "most iterations of one match");
  fields("converged_m", config.converged_m, {1e-9, 0.1}, "a shorter step ends the match");
  fields("converged_rad", config.converged_rad, {1e-9, 0.1}, "… if it also turns less than this");
  fields("unobservable_sigma_m", config.unobservable_sigma_m, {1e-3, 100.0},
         "a direction that the features tell less well than this is held at the prediction");
}

MatchResult match_feature_icp(std::span<const PointFeature> seen, const FeatureMap& map, const Pose2& guess,
                              const FeatureIcpConfig& config, FeatureIcpScratch& scratch) {
  MatchResult result;
  result.map_from_laser = guess;
  result.status = MatchStatus::too_few_pairs;
  Pose2 pose = guess;
  bool is_near = false;
  double scale = 1.0;
  for (int iteration = 1; iteration <= config.max_iterations; ++iteration) {
    // 1. Pair the features one to one, 2. weigh the pairs by what is usual among them.
    make_pairs(seen, map, pose, is_near, config, scale, scratch);
    result.pair_count = static_cast<int>(scratch.pairs.size());
    if (result.pair_count < config.min_pairs) {
      result.map_from_laser = guess;
      result.status = MatchStatus::too_few_pairs;
      return result;
    }
    scale = robust_scale(scratch);
    const Normal normal = with_loss(
        config.loss, config.loss_k_sigma, [&](const auto& loss) { return weigh(scratch.pairs, loss, scale); },
        Residual::in_plane);
    const Observability known(normal.hessian, normal.arm_m, 1.0, config.unobservable_sigma_m);

    // 3. Step: the closed form far away, Gauss-Newton on whitened residuals near by.
    Eigen::Vector3d step = -known.inverse() * normal.gradient;
    if (!is_near)
      if (const auto turn = normal.alignment.solve())
        step = known.determined({turn->x_m, turn->y_m, turn->theta_rad});
    pose = stepped(pose, step);
    result.map_from_laser = pose;
    result.status = MatchStatus::max_iterations;
    result.iterations = iteration;
    result.rank = 3 - known.weak_count;
    result.weak_direction = known.directions.col(0).normalized();
    result.scale_m = scale;
    result.covariance = excess_variance(normal) * known.inverse() + known.unknown();

    // 4. Enough is when nothing moves any more and far pairs are gone.
    const double move_m = step.head<2>().norm();
    const double turn_rad = std::abs(step.z());
    if (is_near && move_m < config.converged_m && turn_rad < config.converged_rad) {
      result.status = MatchStatus::converged;
      break;
    }
    is_near = is_near || (move_m < kNear_m && turn_rad < kNear_rad);
  }
  return result;
}

}  // namespace beaconless
