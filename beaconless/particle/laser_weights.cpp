// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/laser_weights.hpp"

#include <cmath>

#include "beaconless/particle/beam_skip.hpp"

namespace beaconless {

LaserWeights::LaserWeights(const Map& map, const SurfaceMap& surfaces, const Pose2& base_from_laser,
                           const AmclConfig& config)
    : config_(config), base_from_laser_(base_from_laser) {
  if (config.laser_model_type == LaserModel::beam)
    model_.emplace(map, config);
  else
    field_.emplace(surfaces, config);
}

std::size_t LaserWeights::weigh(const Particles& particles, const Scan& scan,
                                std::span<const Eigen::Vector2d> points, bool is_in_one_place,
                                std::vector<double>& logs) {
  if (model_) {
    choose_beams(scan, config_.laser_max_beams, config_.laser_max_range, beams_);
    if (!beams_.empty()) model_->sum(particles, base_from_laser_, beams_, logs);
    return beams_.size();
  }
  choose_ends(points, config_.laser_max_beams, ends_);
  const bool is_prob = config_.laser_model_type == LaserModel::likelihood_field_prob;
  if (config_.do_beamskip && is_prob && is_in_one_place)
    skip_beams(particles, base_from_laser_, *field_, config_, ends_);
  if (ends_.size() == 0) return 0;
  sum_field(particles, base_from_laser_, ends_, *field_, sums_);
  logs.clear();
  for (const std::int32_t sum : sums_) {
    const double value = field_->value_of(sum, ends_.size());
    logs.push_back(is_prob ? value : std::log1p(value));
  }
  return ends_.size();
}

}  // namespace beaconless
