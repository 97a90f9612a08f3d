// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace beaconless {
namespace {

constexpr double kChiSquare1_95 = 3.841;

bool has(std::span<const double> values, std::size_t i) {
  return i < values.size() && std::isfinite(values[i]);
}

bool same_kind(const FeatureSet& first, std::size_t i, const FeatureSet& second, std::size_t j) {
  return first.kinds.empty() || second.kinds.empty() || first.kinds[i] == second.kinds[j];
}

}  // namespace

void describe(Fields& fields, PairingConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 10.0}, "standard deviation of a feature's position, each axis");
  fields("turn_tolerance_rad", config.turn_tolerance_rad, {0.0, kPi},
         "by how much orientations may disagree; pi: they are not looked at");
  fields("max_descriptor_distance", config.max_descriptor_distance, {0.0, 1.0},
         "features whose descriptors differ more are not paired");
  fields("gate_m", config.gate_m, {0.0, 1000.0},
         "features further apart at the guess are not paired; 0: anywhere");
  fields("gate_rad", config.gate_rad, {0.0, kPi},
         "features whose orientations differ more from the guess are not paired");
  fields("max_candidates", config.max_candidates, {3, 4096}, "the most alike so many pairs are considered");
  fields("min_pairs", config.min_pairs, {2, 1000}, "fewer pairs that agree make no match");
  fields("max_chance", config.max_chance, {0.0, 1e12},
         "a match that chance alone would make more often than this is none; large: all are believed");
}

void candidate_pairs(const FeatureSet& first, const FeatureSet& second, std::span<const float> distances,
                     const Pose2& second_from_first_guess, const PairingConfig& config,
                     std::vector<FeaturePair>& out) {
  out.clear();
  const bool looks = !distances.empty();
  if (looks && distances.size() != first.points.size() * second.points.size()) return;  // of other sets
  const bool gated = config.gate_m > 0.0;
  const double reach_m2 = gated ? config.gate_m * config.gate_m : 1.0;
  out.reserve(first.points.size() * second.points.size());

  // 1. Every pair that passes kind, look and gate.
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    if (!first.points[i].allFinite()) continue;
    const Eigen::Vector2d at = second_from_first_guess * first.points[i];
    for (std::size_t j = 0; j < second.points.size(); ++j) {
      if (!second.points[j].allFinite() || !same_kind(first, i, second, j)) continue;
      double cost = 0.0;
      if (looks) {
        const auto unlike = static_cast<double>(distances[i * second.points.size() + j]);
        if (!(unlike <= config.max_descriptor_distance)) continue;
        cost += unlike / std::max(config.max_descriptor_distance, 1e-9);
      }
      if (gated || !looks) {
        const double apart_m2 = (second.points[j] - at).squaredNorm();
        if (gated && apart_m2 > reach_m2) continue;
        cost += apart_m2 / reach_m2;
      }
      if (config.gate_rad < kPi && has(first.orientations_rad, i) && has(second.orientations_rad, j) &&
          std::abs(wrap_angle(second.orientations_rad[j] - first.orientations_rad[i] -
                              second_from_first_guess.theta_rad)) > config.gate_rad)
        continue;
      out.push_back({i, j, cost});
    }
  }

  // 2. Too many: keep the cheapest, in the old order.
  const auto most = static_cast<std::size_t>(config.max_candidates);
  if (out.size() <= most) return;
  const auto cheaper = [](const FeaturePair& a, const FeaturePair& b) {
    return std::tie(a.cost, a.first, a.second) < std::tie(b.cost, b.first, b.second);
  };
  std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(most), out.end(), cheaper);
  out.resize(most);
  std::sort(out.begin(), out.end(), [](const FeaturePair& a, const FeaturePair& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
}

PairAgreement::PairAgreement(const FeatureSet& first, const FeatureSet& second, const PairingConfig& config)
    : first_(first),
      second_(second),
      length_test_m2_(kChiSquare1_95 * 8.0 * config.sigma_m * config.sigma_m),
      sigma_m_(config.sigma_m),
      tolerance_rad_(config.turn_tolerance_rad),
      oriented_(!first.orientations_rad.empty() && !second.orientations_rad.empty() &&
                config.turn_tolerance_rad < kPi) {}

bool PairAgreement::agree(const FeaturePair& a, const FeaturePair& b) const {
  if (a.first == b.first || a.second == b.second) return false;
  const Eigen::Vector2d p = first_.points[b.first] - first_.points[a.first];
  const Eigen::Vector2d q = second_.points[b.second] - second_.points[a.second];
  const double square_p = p.squaredNorm();
  const double square_q = q.squaredNorm();
  const double difference = square_p - square_q;
  if (difference * difference > length_test_m2_ * (square_p + square_q)) return false;
  if (!oriented_) return true;
  const double turn_a = second_.orientations_rad[a.second] - first_.orientations_rad[a.first];
  const double turn_b = second_.orientations_rad[b.second] - first_.orientations_rad[b.first];
  if (std::abs(wrap_angle(turn_a - turn_b)) > tolerance_rad_) return false;
  const double length_m = std::sqrt(std::max(square_p, square_q));
  if (length_m < 4.0 * sigma_m_) return true;  // too short a line to have a direction
  const double line_turn = std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
  const double middle = turn_a + 0.5 * wrap_angle(turn_b - turn_a);
  return std::abs(wrap_angle(line_turn - middle)) <= tolerance_rad_ + 4.0 * sigma_m_ / length_m;
}

bool PairAgreement::turns_like(const FeaturePair& pair, double turn_rad) const {
  if (!oriented_) return true;
  const double turn = second_.orientations_rad[pair.second] - first_.orientations_rad[pair.first];
  return std::abs(wrap_angle(turn - turn_rad)) <= tolerance_rad_;
}

}  // namespace beaconless
