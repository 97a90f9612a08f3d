// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/clusters.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

Eigen::Vector3d difference(const Pose2& pose, const Pose2& from) {
  return {pose.x_m - from.x_m, pose.y_m - from.y_m, wrap_heading(pose.theta_rad - from.theta_rad)};
}

}  // namespace

void ClusterFinder::reserve(std::size_t particles) {
  bins_.clear(particles);
  for (auto* list : {&bin_of_, &parent_, &cluster_of_}) list->reserve(particles);
  direction_.reserve(particles);
  clusters_.reserve(particles);
}

int ClusterFinder::root_of(int bin) {
  while (parent_[static_cast<std::size_t>(bin)] != bin) {
    int& above = parent_[static_cast<std::size_t>(bin)];
    above = parent_[static_cast<std::size_t>(above)];
    bin = above;
  }
  return bin;
}

void ClusterFinder::join_neighbours() {
  const auto count = static_cast<int>(bins_.count());
  for (int bin = 0; bin < count; ++bin) {
    const PoseBins::Key key = bins_.key(bin);
    for (int code = 0; code < 27; ++code) {
      const PoseBins::Key beside{key[0] + code % 3 - 1, key[1] + code / 3 % 3 - 1,
                                 (key[2] + code / 9 - 1 + PoseBins::kHeadings) % PoseBins::kHeadings};
      const int other = bins_.find(beside);
      if (other <= bin) continue;  // none, itself, or seen from there
      const int one_root = root_of(bin);
      const int other_root = root_of(other);
      parent_[static_cast<std::size_t>(std::max(one_root, other_root))] = std::min(one_root, other_root);
    }
  }
}

const std::vector<Cluster>& ClusterFinder::find(const Particles& particles) {
  // 1. Bins, and which of them touch.
  bins_.clear(particles.size());
  bin_of_.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) bin_of_.push_back(bins_.add(particles.pose(i)));
  parent_.clear();
  for (std::size_t bin = 0; bin < bins_.count(); ++bin) parent_.push_back(static_cast<int>(bin));
  join_neighbours();
  // 2. A number for each cluster; a root is the first of its bins.
  clusters_.clear();
  cluster_of_.clear();
  for (std::size_t bin = 0; bin < bins_.count(); ++bin) {
    const int root = root_of(static_cast<int>(bin));
    if (root == static_cast<int>(bin)) {
      cluster_of_.push_back(static_cast<int>(clusters_.size()));
      clusters_.emplace_back();
    } else {
      cluster_of_.push_back(cluster_of_[static_cast<std::size_t>(root)]);
    }
  }
  // 3. Their means and covariances.
  sum_up(particles);
  std::sort(clusters_.begin(), clusters_.end(),
            [](const Cluster& a, const Cluster& b) { return a.weight > b.weight; });
  return clusters_;
}

void ClusterFinder::sum_up(const Particles& particles) {
  direction_.assign(clusters_.size(), Eigen::Vector2d::Zero());
  const auto number_of = [&](std::size_t i) {
    return static_cast<std::size_t>(cluster_of_[static_cast<std::size_t>(bin_of_[i])]);
  };
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::size_t of = number_of(i);
    const double weight = particles.weight[i];
    clusters_[of].weight += weight;
    clusters_[of].mean.x_m += weight * particles.x_m[i];
    clusters_[of].mean.y_m += weight * particles.y_m[i];
    direction_[of] +=
        weight * Eigen::Vector2d(std::cos(particles.theta_rad[i]), std::sin(particles.theta_rad[i]));
  }
  for (std::size_t of = 0; of < clusters_.size(); ++of) {
    Cluster& cluster = clusters_[of];
    const double share = cluster.weight > 0.0 ? 1.0 / cluster.weight : 0.0;
    cluster.mean = {share * cluster.mean.x_m, share * cluster.mean.y_m,
                    wrap_angle(std::atan2(direction_[of].y(), direction_[of].x()))};
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Cluster& cluster = clusters_[number_of(i)];
    if (!(cluster.weight > 0.0)) continue;
    const Eigen::Vector3d off = difference(particles.pose(i), cluster.mean);
    cluster.covariance += particles.weight[i] / cluster.weight * off * off.transpose();
  }
}

Eigen::Matrix3d spread_around(const Pose2& pose, const std::vector<Cluster>& clusters) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Cluster& cluster : clusters) {
    const Eigen::Vector3d off = difference(cluster.mean, pose);
    spread += cluster.weight * (cluster.covariance + off * off.transpose());
  }
  return spread;
}

}  // namespace beaconless
