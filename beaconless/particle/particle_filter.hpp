// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/rng.hpp"
#include "beaconless/particle/clusters.hpp"
#include "beaconless/particle/free_space.hpp"
#include "beaconless/particle/laser_weights.hpp"
#include "beaconless/particle/mean_weights.hpp"
#include "beaconless/particle/odometry_motion.hpp"

namespace beaconless {

/// Adaptive Monte-Carlo localization: a cloud of poses of the base that moves with the robot and is thinned
/// out by scans.
///
/// Source: Thrun et al., tables 8.2 (MCL), 8.3 (augmented), 8.4 (KLD); ROS's amcl for the names and the order
/// of things. Differs: a scan is tempered so that its beams count as `laser_independent_beams`, and more
/// where it would leave hardly a particle effective (a start anywhere); how many particles are drawn follows
/// from the bins that a comb of `max_particles` would touch, which is Fox's bound met from above; those drawn
/// are not drawn one by one but by one comb. The same seed gives the same bits. Allocates nothing after it
/// was made, but for a start anywhere within a region.
class ParticleFilter {
 public:
  ParticleFilter(const Map& map, const SurfaceMap& surfaces, const Pose2& base_from_laser,
                 const AmclConfig& config);

  /// A cloud around a pose. In: the covariance of (x, y, theta), map axes.
  void start_at(const Pose2& map_from_base, const Eigen::Matrix3d& covariance);

  /// A cloud all over the free space, or a part of it.
  void start_anywhere() { spread_over(free_space_); }
  void start_within(const Eigen::Vector2d& middle, double radius_m) {
    spread_over(free_space_.within(middle, radius_m));
  }

  /// Moves the cloud by what the wheels tell (base before to base after).
  void move(const OdometryStep& step) { move_by_odometry(step, rng_, particles_); }

  /// Moves it by a motion that is known to a covariance.
  void move(const Pose2& motion, const Eigen::Matrix3d& covariance);

  /// Weighs it by a scan and sums it up. False, and nothing changes, where no beam tells anything.
  bool weigh(const Scan& scan, std::span<const Eigen::Vector2d> points);

  /// Draws anew where that is due. In: whether some particles are put anywhere where scans fit worse than
  /// they did; poses (map_from_base) that a search found, around which half of those are put.
  void resample(bool may_recover, std::span<const Pose2> hints = {});

  /// Of the cloud as it was weighed last, the heaviest first.
  const std::vector<Cluster>& clusters() const { return *clusters_; }
  const Particles& particles() const { return particles_; }

  /// What share of the next particles is put anywhere: 0 as long as scans fit as they did.
  double lost_share() const { return means_.lost_share(); }

 private:
  void spread_over(const FreeSpace& space);
  void set_weights(std::size_t beams);
  double weigh_tempered(double temper);
  std::size_t wanted_count();

  AmclConfig config_;
  LaserWeights laser_;
  FreeSpace free_space_;
  Rng rng_;
  MeanWeights means_;
  ClusterFinder finder_;
  PoseBins bins_;
  Particles particles_;
  Particles drawn_;
  std::vector<double> logs_;
  std::vector<double> before_;  // weights before a scan
  const std::vector<Cluster>* clusters_ = nullptr;
  int updates_ = 0;  // since particles were drawn
};

}  // namespace beaconless
