// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/detector.hpp"

namespace beaconless {

/// A place that can be told from its surroundings, in a scan or in a map, with what is known of it.
struct PointFeature {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of point, m², in the frame of point
  double orientation_rad = 0.0;                          ///< in [-pi, pi); of a corner, its bisector
  double opening_rad = 0.0;  ///< between the two walls of a corner, in (0, pi); 0 where not told
};

/// How well each detector places what it finds, where it does not tell itself.
struct PointFeaturesConfig {
  DetectorsConfig detectors;
  double rdp_sigma_m = 0.03;    ///< of a Douglas-Peucker vertex along each axis; a beam beside the corner
  double falko_sigma_m = 0.01;  ///< … of a keypoint of FALKO
  double oc_sigma_m = 0.01;     ///< … of OC
  double flirt_sigma_m = 0.03;  ///< … of FLIRT, of any kind
};

void describe(Fields& fields, PointFeaturesConfig& config);

/// Buffers that live on from scan to scan.
struct PointFeaturesScratch {
  DetectorScratch detecting;
  std::vector<Keypoint> keypoints;
};

/// Runs a detector and tells of each thing found how sure its place is. Corners bring their own covariance;
/// keypoints have the same in all directions, by the config.
///
/// Out: sensor frame, in the detector's order. Cost: detect(), nothing allocated once the buffers have grown.
void find_point_features(const Scan& scan, Detector detector, const PointFeaturesConfig& config,
                         PointFeaturesScratch& scratch, std::vector<PointFeature>& features);
std::vector<PointFeature> find_point_features(const Scan& scan, Detector detector,
                                              const PointFeaturesConfig& config = {});

}  // namespace beaconless
