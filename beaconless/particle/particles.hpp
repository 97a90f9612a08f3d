// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// wrap_angle(), at once where there is nothing to wrap: its division takes longer than the rest of what is
/// done with a particle's heading.
inline double wrap_heading(double angle_rad) {
  return angle_rad >= -kPi && angle_rad < kPi ? angle_rad : wrap_angle(angle_rad);
}

/// Poses of the base that may be the robot's (map_from_base), each with a weight; side by side, a list a
/// coordinate, because loops over particles read one after the other.
///
/// Weights add up to 1.
struct Particles {
  std::vector<double> x_m;
  std::vector<double> y_m;
  std::vector<double> theta_rad;
  std::vector<double> weight;

  std::size_t size() const { return x_m.size(); }
  Pose2 pose(std::size_t i) const { return {x_m[i], y_m[i], theta_rad[i]}; }

  void reserve(std::size_t count) {
    for (auto* list : {&x_m, &y_m, &theta_rad, &weight}) list->reserve(count);
  }
  void clear() {
    for (auto* list : {&x_m, &y_m, &theta_rad, &weight}) list->clear();
  }
  void add(const Pose2& map_from_base, double its_weight) {
    x_m.push_back(map_from_base.x_m);
    y_m.push_back(map_from_base.y_m);
    theta_rad.push_back(map_from_base.theta_rad);
    weight.push_back(its_weight);
  }

  friend bool operator==(const Particles&, const Particles&) = default;
};

}  // namespace beaconless
