// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/gaussian_motion.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace beaconless {

void move_by_gaussian(const Pose2& motion, const Eigen::Matrix3d& covariance, Rng& rng,
                      Particles& particles) {
  // A root that any semidefinite matrix has; Cholesky's fails on those of no rank.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Matrix3d root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double first = rng.normal();
    const double second = rng.normal();
    const double third = rng.normal();
    const Eigen::Vector3d error = root * Eigen::Vector3d(first, second, third);
    const double ahead = motion.x_m + error.x();
    const double left = motion.y_m + error.y();
    double& theta = particles.theta_rad[i];
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    particles.x_m[i] += c * ahead - s * left;
    particles.y_m[i] += s * ahead + c * left;
    theta = wrap_heading(theta + motion.theta_rad + error.z());
  }
}

}  // namespace beaconless
