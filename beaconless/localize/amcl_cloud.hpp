// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/map/nearness_pyramid.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/particle/particle_filter.hpp"

namespace beaconless {

/// A cloud of particles from scan to scan: carried on by each step, weighed and drawn anew every so far.
///
/// Between updates wheels carry its mean on; without wheels the cloud itself moves, and every scan is an
/// update. Where the robot is lost, it is fed with what a search around it finds.
class AmclCloud {
 public:
  /// How the robot moved from the last scan to this one.
  struct Step {
    Pose2 motion;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the motion; not of wheels'
    bool is_by_wheels = false;
    Twist2 twist_per_s;  ///< from now on, base frame
  };
  /// Where the robot is, by the cloud or what came of it.
  struct Belief {
    Pose2 map_from_base;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  AmclCloud(const LocalizerConfig& config, const Map& map, std::shared_ptr<const SurfaceMap> surfaces);

  void start_at(const Pose2& map_from_base);
  void start_anywhere(const std::optional<SearchRegion>& within);

  /// The belief moves on, and the cloud with it where wheels do not tell the way.
  void carry(const Step& step);

  /// Whether it has moved far enough to be weighed.
  bool is_due(const Step& step) const;

  /// Weighs it by a scan, whose points are in the laser frame at its stamp, and draws it anew.
  void weigh(const Scan& scan, std::span<const Eigen::Vector2d> points, bool is_lost);

  const Belief& now() const { return now_; }
  const std::vector<Cluster>& clusters() const { return filter_.clusters(); }
  double heaviest() const { return heaviest_; }  ///< share of the heaviest cluster
  bool is_one_place() const;
  bool is_wide() const;                        ///< wider than a pose can be told from
  bool is_blind() const { return is_blind_; }  ///< the last scan had no beam to weigh by

 private:
  void begin(const Belief& belief);
  void search_where_lost(std::span<const Eigen::Vector2d> points, bool is_lost);

  LocalizerConfig config_;
  std::shared_ptr<const SurfaceMap> map_;
  NearnessPyramid nearness_;
  ParticleFilter filter_;
  Belief at_update_;  // the cloud's, when it was weighed last …
  Pose2 since_;       // … and how wheels have moved the base since
  Belief now_;        // both together
  double heaviest_ = 0.0;
  bool is_blind_ = false;
  LocalSearchScratch search_scratch_;
  std::vector<StartPose> starts_;
  std::vector<Pose2> hints_;
  int lost_scans_ = 0;
};

}  // namespace beaconless
