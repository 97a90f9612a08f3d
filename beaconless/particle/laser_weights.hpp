// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/map.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/particle/amcl_config.hpp"
#include "beaconless/particle/beam_model.hpp"
#include "beaconless/particle/field_sums.hpp"
#include "beaconless/particle/laser_beams.hpp"
#include "beaconless/particle/likelihood_field.hpp"
#include "beaconless/particle/particles.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// Tells how well a scan fits each particle, by the laser model that a config names.
///
/// Cost: that of sum_field() or BeamModel::sum(); nothing is allocated once its lists have grown.
class LaserWeights {
 public:
  /// In: a map and its surfaces, which are felt as far as `laser_likelihood_max_dist`.
  LaserWeights(const Map& map, const SurfaceMap& surfaces, const Pose2& base_from_laser,
               const AmclConfig& config);

  /// In: a scan and the ends of its beams (laser frame at its stamp); whether the cloud is in one place, so
  /// that beams may be skipped. Out: the log of each particle's weight. Returns how many beams weighed; with
  /// none the list is not filled.
  std::size_t weigh(const Particles& particles, const Scan& scan, std::span<const Eigen::Vector2d> points,
                    bool is_in_one_place, std::vector<double>& logs);

 private:
  AmclConfig config_;
  Pose2 base_from_laser_;
  std::optional<LikelihoodField> field_;
  std::optional<BeamModel> model_;
  BeamEnds ends_;
  std::vector<CastBeam> beams_;
  std::vector<std::int32_t> sums_;
};

}  // namespace beaconless
