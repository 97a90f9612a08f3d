// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/localize/scan_points.hpp"

namespace beaconless {

/// Fits points of a scan to the map as points, whatever they were taken for.
class PointsMatcher final : public ScanMatcher {
 public:
  using Fit = std::function<MatchResult(std::span<const Eigen::Vector2d> points, const Pose2& guess)>;

  PointsMatcher(ScanPoints points, Fit fit) : points_(std::move(points)), fit_(std::move(fit)) {}

  void observe(const Scan& scan, std::span<const Eigen::Vector2d> points, const Pose2& /*expected*/,
               const Eigen::Matrix3d& /*covariance*/) override {
    seen_ = points_.of(scan, points);
  }
  MatchResult match(const Pose2& guess) override { return fit_(seen_, guess); }
  bool judges_whole_scan() const override { return points_.from() == PointsFrom::whole_scan; }
  std::string_view too_few_pairs() const override { return "too few beams end near a wall of the map"; }

 private:
  ScanPoints points_;
  Fit fit_;
  std::span<const Eigen::Vector2d> seen_;  // into points_, or those of the scan
};

}  // namespace beaconless
