// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/point_feature.hpp"

namespace beaconless {
namespace {

PointFeature feature_of(const Corner& corner) {
  return {corner.point, corner.covariance, corner.orientation_rad, corner.angle_rad};
}

double sigma_m(Detector detector, const PointFeaturesConfig& config) {
  switch (detector) {
    case Detector::rdp:
      return config.rdp_sigma_m;
    case Detector::falko:
      return config.falko_sigma_m;
    case Detector::oc:
      return config.oc_sigma_m;
    default:
      return config.flirt_sigma_m;
  }
}

}  // namespace

void describe(Fields& fields, PointFeaturesConfig& config) {
  describe(fields, config.detectors);
  fields("rdp_sigma_m", config.rdp_sigma_m, {1e-4, 1.0}, "how well a Douglas-Peucker vertex is placed");
  fields("falko_sigma_m", config.falko_sigma_m, {1e-4, 1.0}, "how well a keypoint of FALKO is placed");
  fields("oc_sigma_m", config.oc_sigma_m, {1e-4, 1.0}, "how well a keypoint of OC is placed");
  fields("flirt_sigma_m", config.flirt_sigma_m, {1e-4, 1.0}, "how well a keypoint of FLIRT is placed");
}

void find_point_features(const Scan& scan, Detector detector, const PointFeaturesConfig& config,
                         PointFeaturesScratch& scratch, std::vector<PointFeature>& features) {
  features.clear();
  if (detector == Detector::corners) {
    DetectorScratch& of = scratch.detecting;
    find_corners(scan, config.detectors.corners, of.corners, of.found_corners);
    for (const Corner& corner : of.found_corners) features.push_back(feature_of(corner));
    return;
  }
  detect(scan, detector, config.detectors, scratch.detecting, scratch.keypoints);
  const double sigma = sigma_m(detector, config);
  for (const Keypoint& keypoint : scratch.keypoints)
    features.push_back(
        {keypoint.point, sigma * sigma * Eigen::Matrix2d::Identity(), keypoint.orientation_rad, 0.0});
}

std::vector<PointFeature> find_point_features(const Scan& scan, Detector detector,
                                              const PointFeaturesConfig& config) {
  PointFeaturesScratch scratch;
  std::vector<PointFeature> features;
  find_point_features(scan, detector, config, scratch, features);
  return features;
}

}  // namespace beaconless
