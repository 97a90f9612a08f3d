// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/features/point_feature.hpp"
#include "beaconless/geometry/point_buckets.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless {

/// On what a feature of a map rests.
struct FeatureEvidence {
  int found_views = 0;     ///< views of the map that it was found in; 0 where it was read off a plan
  double share = 1.0;      ///< … of those near enough that see its place
  double scatter_m = 0.0;  ///< root mean square distance of the finds from their mean
};

/// The point features that a scan in a known building may show, and a quick way to those near a place.
struct FeatureMap {
  std::vector<PointFeature> features;     ///< map frame
  std::vector<FeatureEvidence> evidence;  ///< one a feature
  PointBuckets places;                    ///< of features[i].point
};

/// How the features of a map are found.
struct FeatureMapConfig {
  double map_sigma_m = 0.0;       ///< by how much the map's walls are off; 0: what the map's kind suggests
  double view_step_m = 0.75;      ///< distance between the places that the map is looked at from
  double view_clearance_m = 0.3;  ///< no wall is nearer to them
  double view_range_m = 30.0;     ///< how far is looked
  double view_beam_deg = 0.25;    ///< between two beams; that of the scanner
  int max_views = 2500;           ///< of larger maps the step is made larger
  double same_place_m = 0.10;     ///< finds within this distance of their mean …
  double same_turn_deg = 25.0;    ///< … that are turned alike are one feature
  int min_views = 3;              ///< features found in fewer views are left out …
  double min_share = 0.25;        ///< … or in a smaller share of those that see their place
};

void describe(Fields& fields, FeatureMapConfig& config);

/// The features of a map that a detector finds in scans taken there.
///
/// Corners of a floor plan (for `corners` and `rdp`) are read off its walls. All else is looked at as a robot
/// would: noise-free sweeps of a whole turn from places all over the free space go through the detector with
/// the parameters it has for scans, and what is found at one place from many of them is a feature. What is
/// seen only from somewhere, as where one wall hides another, is not. A grid is looked at through the
/// outlines of its cells (see outlines_of), so that corners lie better than a cell.
///
/// Out: covariance is the scatter of the finds plus the map's own error. Errors: a field outside of its
/// range, a map without walls, no place to look from, nothing found; each names what else to try. Cost: views
/// x (a sweep + the detector); deterministic.
Result<FeatureMap> build_feature_map(const Map& map, Detector detector,
                                     const PointFeaturesConfig& detecting = {},
                                     const FeatureMapConfig& config = {});

}  // namespace beaconless
