// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless {

/// Where a robot can stand on a map: cells that are known to be free, or of a plan those that its walls shut
/// in.
///
/// A plan whose walls shut in less than a quarter of the box around them is open: then it is all of the box
/// but the walls. Cost: built in time linear in the cells.
class FreeSpace {
 public:
  explicit FreeSpace(const Map& map);

  /// The part of it in a disc, or the disc itself where that has no part of it.
  FreeSpace within(const Eigen::Vector2d& middle, double radius_m) const;

  /// A pose anywhere in it, each as likely as the others.
  Pose2 sample(Rng& rng) const;

  double area_m2() const { return static_cast<double>(cells_.size()) * cell_m_ * cell_m_; }

 private:
  FreeSpace() = default;

  double cell_m_ = 0.1;
  Pose2 map_from_cells_;
  std::vector<Cell> cells_;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // of the disc, where there are no cells
  double radius_m_ = 0.0;
};

}  // namespace beaconless
