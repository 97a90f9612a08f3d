// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/particle/particles.hpp"
#include "beaconless/particle/pose_bins.hpp"

namespace beaconless {

/// Particles that lie together.
struct Cluster {
  Pose2 mean;  ///< weighted; its heading is that of the weighted sum of directions
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< weighted, of (x, y, theta), map axes
  double weight = 0.0;                                   ///< of all its particles
};

/// Finds which particles lie together: in the same bin, or in bins that touch. Headings are a circle.
///
/// Source: the clusters of ROS's amcl. Allocates nothing once its lists have grown.
class ClusterFinder {
 public:
  /// Makes room for so many particles.
  void reserve(std::size_t particles);

  /// Clusters of the particles, the heaviest first; they stay until the next call. Cost: linear in the
  /// particles, 26 look-ups a bin.
  const std::vector<Cluster>& find(const Particles& particles);

 private:
  int root_of(int bin);
  void join_neighbours();
  void sum_up(const Particles& particles);

  PoseBins bins_;
  std::vector<int> bin_of_;      // each particle's
  std::vector<int> parent_;      // of each bin, in the tree of its cluster
  std::vector<int> cluster_of_;  // of each bin
  std::vector<Eigen::Vector2d> direction_;
  std::vector<Cluster> clusters_;
};

/// The covariance of all particles around one pose, as clusters tell it: how far off the pose may be if any
/// of them may be the robot's.
Eigen::Matrix3d spread_around(const Pose2& pose, const std::vector<Cluster>& clusters);

}  // namespace beaconless
