// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/icp.hpp"
#include "beaconless/match/walls.hpp"

namespace beaconless {

/// Fits every beam to the wall that it hits: from where the robot is expected at once, from anywhere else
/// after ICP has come near.
class WallsMatcher final : public ScanMatcher {
 public:
  /// In: walls, which the surfaces are made of.
  WallsMatcher(std::shared_ptr<const WallIndex> walls, const WallsConfig& config, const IcpConfig& coarse);

  void observe(const Scan& scan, std::span<const Eigen::Vector2d> points, const Pose2& expected,
               const Eigen::Matrix3d& covariance) override;
  MatchResult match(const Pose2& guess) override;
  bool judges_whole_scan() const override { return true; }
  bool tells_protection() const override { return true; }
  std::string_view too_few_pairs() const override { return "too few beams end near a wall of the map"; }

 private:
  std::shared_ptr<const WallIndex> walls_;
  WallsConfig config_;
  IcpConfig coarse_;
  WallsScratch scratch_;
  IcpScratch coarse_scratch_;
  std::span<const Eigen::Vector2d> points_;
  Pose2 expected_;
  double prior_m_ = 0.0;  // how far a point of a wall may be from where it is expected
};

}  // namespace beaconless
