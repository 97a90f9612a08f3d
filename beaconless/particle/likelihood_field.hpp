// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/surface_map.hpp"
#include "beaconless/particle/amcl_config.hpp"

namespace beaconless {

/// What the end of a beam says of a pose, for every place of the map: a byte a cell, so that the table of a
/// hall stays in the second cache.
///
/// With likelihood_field_prob a byte counts equal steps of log p from low() on, else steps of p³; p = z_hit
/// exp(-d² / 2 sigma²) + z_rand / max_range, d to the nearest surface and at most max_dist, which is also
/// that of places off the table. Sums of bytes are whole numbers: the same in any order. Frame: map, cells
/// along its axes; those at the rim stand for all beyond. Cost: a look-up of the nearest surface a cell;
/// cells are made larger where there would be more than kMaxCells. Source: Thrun et al., table 6.3; ROS's
/// amcl. Differs: distances to surfaces instead of to the middles of cells; steps of bytes.
class LikelihoodField {
 public:
  static constexpr int kSteps = 255;
  static constexpr double kMaxCells = 16e6;
  static constexpr std::size_t kPadding = 8;  ///< bytes behind the last cell, for wide loads

  LikelihoodField(const SurfaceMap& map, const AmclConfig& config);

  double cell_m() const { return cell_m_; }
  const Eigen::Vector2d& low() const { return low_; }  ///< the corner of cell (0, 0)
  int width_cells() const { return width_; }
  int height_cells() const { return height_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }  ///< row by row

  /// What a sum of `beams` bytes stands for: the sum of log p, or of p³.
  double value_of(std::int64_t sum, std::size_t beams) const {
    return static_cast<double>(beams) * least_ + step_ * static_cast<double>(sum);
  }

  /// The byte of a place at a distance from the nearest surface.
  std::uint8_t byte_of(double distance_m) const;

 private:
  double term(double distance_m) const;

  AmclConfig config_;
  double cell_m_ = 0.0;
  double least_ = 0.0;
  double step_ = 1.0;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace beaconless
