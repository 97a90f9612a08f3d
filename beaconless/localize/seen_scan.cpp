// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/seen_scan.hpp"

#include <utility>

#include "beaconless/scan/deskew.hpp"

namespace beaconless {
namespace {

constexpr double kCovered_m = 0.5;      // where fewer beams than the next share reach further than this …
constexpr double kCoveredShare = 0.05;  // … anything fits anywhere
constexpr std::size_t kChecks = 240;    // beams that check a pose: the share is then known to 3 %

/// Whether hardly a beam comes from far away. Mostly the first few tell.
bool are_all_near(std::span<const Eigen::Vector2d> points, std::size_t beams) {
  const double enough = kCoveredShare * static_cast<double>(beams);
  double far = 0.0;
  for (const Eigen::Vector2d& point : points) {
    if (far >= enough) break;
    if (point.squaredNorm() > kCovered_m * kCovered_m) far += 1.0;
  }
  return far < enough;
}

}  // namespace

SeenScan::SeenScan(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
                   std::unique_ptr<ScanMatcher> matcher)
    : map_(std::move(map)),
      matcher_(std::move(matcher)),
      icp_(config.icp),
      base_from_laser_(config.base_from_laser),
      laser_from_base_(config.base_from_laser.inverse()),
      deskew_(config.deskew) {}

bool SeenScan::is_unbent(const Scan& scan) const {
  return deskew_ && matcher_->judges_whole_scan() && scan.sweep_time_s() > 0.0;
}

void SeenScan::see(const Scan& scan, const ToldTwist& motion, const Pose2& expected,
                   const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d twist = laser_from_base_.adjoint() * motion.per_s;
  points_at_stamp(scan, is_unbent(scan) ? Twist2{twist.x(), twist.y(), twist.z()} : Twist2{}, points_);
  is_covered_ = are_all_near(points_, scan.size());
  matcher_->observe(scan, points_, expected, covariance);
}

MatchResult SeenScan::fit_from(const Pose2& guess) {
  MatchResult match = matcher_->match(guess);
  if (!match.usable() || matcher_->judges_whole_scan()) return match;
  // A dozen corners can fit a wrong place; beams from all around that then do not lie on the map tell.
  const std::size_t stride = points_.size() / kChecks;
  const MapFit fit = fit_to_map(points_, *map_, match.map_from_laser, icp_.on_map_m, stride);
  match.on_map_ratio = fit.on_map_ratio;
  match.misfit = fit.misfit;
  return match;
}

MatchResult SeenScan::fit_whole_from(const Pose2& guess) {
  return match_icp(points_, *map_, guess, icp_, scratch_);
}

MapFit SeenScan::fit_at(const Prediction& prediction) const {
  return fit_to_map(points_, *map_, prediction.map_from_base * base_from_laser_, icp_.on_map_m);
}

}  // namespace beaconless
