// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/map/surface_point.hpp"

namespace beaconless {

/// `icp-full`: every point of the scan against the walls (or the surface cells) of the map.
///
/// Source: dissertation 3.2, second approach; prediction from the last two poses.
/// Differs: a sweep is fitted as if taken at once; what the robot's motion during it adds is put into the
/// covariance. See match_icp; a fit that explains unusually little of the scan is tried again from the best
/// poses around the prediction (search_around), because a robot that turns by 20° between two scans is
/// outside ICP's basin.
template <SurfaceIndex Index>
class IcpLocalizer final : public Localizer {
 public:
  IcpLocalizer(const LocalizerConfig& config, Index map);

  void start_at(const Pose2& map_from_base) override;
  PoseEstimate update(const Event& event) override;

 private:
  void load(const Scan& scan);
  bool is_jump(const MatchResult& match, const Prediction& prediction) const;
  bool is_worth_searching(const MatchResult& match, const Prediction& prediction);
  std::string_view reason_to_coast(const MatchResult& match, const Prediction& prediction) const;
  MatchResult try_other_starts(const MatchResult& first, const Prediction& prediction);
  PoseEstimate accept(const MatchResult& match, const Prediction& prediction, const Scan& scan);
  PoseEstimate coast(const Prediction& prediction, Stamp stamp, std::string_view reason);

  LocalizerConfig config_;
  Index map_;
  Pose2 laser_from_base_;
  MotionFilter motion_;
  Health health_;
  IcpScratch scratch_;
  std::vector<Eigen::Vector2d> points_;  // laser frame
  PoseEstimate last_;
  bool started_ = false;
  bool first_scan_ = true;
  bool is_covered_ = false;
  int lost_scans_ = 0;
};

}  // namespace beaconless
