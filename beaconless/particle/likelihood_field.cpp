// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/likelihood_field.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {

LikelihoodField::LikelihoodField(const SurfaceMap& map, const AmclConfig& config)
    : config_(config), cell_m_(config.laser_field_cell) {
  // 1. What bytes mean.
  least_ = term(config.laser_likelihood_max_dist);
  step_ = std::max((term(0.0) - least_) / kSteps, 1e-12);
  // 2. A table as wide as surfaces are felt, and a rim.
  const FloorPlan::Bounds bounds = bounds_of(map);
  const double margin_m = config.laser_likelihood_max_dist;
  const Eigen::Vector2d extent = (bounds.high - bounds.low).array() + 2.0 * margin_m;
  cell_m_ = std::max(cell_m_, std::sqrt(extent.x() * extent.y() / kMaxCells));
  width_ = static_cast<int>(std::ceil(extent.x() / cell_m_)) + 2;
  height_ = static_cast<int>(std::ceil(extent.y() / cell_m_)) + 2;
  low_ = bounds.low.array() - (margin_m + cell_m_);
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  bytes_.assign(count + kPadding, 0);
  // 3. Filled.
  std::visit(
      [&](const auto& index) {
        std::size_t place = 0;
        for (int y = 0; y < height_; ++y)
          for (int x = 0; x < width_; ++x, ++place) {
            const bool is_rim = x == 0 || y == 0 || x + 1 == width_ || y + 1 == height_;
            const auto surface = index.nearest(low_ + cell_m_ * Eigen::Vector2d(x + 0.5, y + 0.5));
            bytes_[place] = is_rim || !surface ? 0 : byte_of(surface->distance_m);
          }
      },
      map);
}

double LikelihoodField::term(double distance_m) const {
  const double sigmas = distance_m / config_.laser_sigma_hit;
  const double p = config_.laser_z_hit * std::exp(-0.5 * sigmas * sigmas) +
                   config_.laser_z_rand / config_.laser_max_range + 1e-9;
  return config_.laser_model_type == LaserModel::likelihood_field ? p * p * p : std::log(p);
}

std::uint8_t LikelihoodField::byte_of(double distance_m) const {
  const double distance = std::min(distance_m, config_.laser_likelihood_max_dist);
  const double steps = (term(distance) - least_) / step_;
  return static_cast<std::uint8_t>(std::lround(std::clamp(steps, 0.0, double{kSteps})));
}

}  // namespace beaconless
