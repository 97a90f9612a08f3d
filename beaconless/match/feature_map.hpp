// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/features/point_feature.hpp"
#include "beaconless/geometry/point_buckets.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/match/grid_outlines.hpp"
#include "beaconless/match/map_views.hpp"
#include "beaconless/match/repeated_finds.hpp"

namespace beaconless {

/// The point features that a scan in a known building may show, and a quick way to those near a place.
struct FeatureMap {
  std::vector<PointFeature> features;     ///< map frame
  std::vector<FeatureEvidence> evidence;  ///< one a feature
  PointBuckets places;                    ///< of features[i].point
};

/// How the features of a map are found.
struct FeatureMapConfig {
  double map_sigma_m = 0.0;     ///< by how much the map's walls are off; 0: what the map's kind suggests
  MapViewsConfig views;         ///< from where it is looked at
  RepeatedFindsConfig finds;    ///< what counts as found
  GridOutlinesConfig outlines;  ///< how the walls of a grid are drawn for that
};

void describe(Fields& fields, FeatureMapConfig& config);

/// The features of a map that a detector finds in scans taken there.
///
/// The map is looked at as a robot would: noise-free sweeps of a whole turn from places all over its free
/// space go through the detector with the parameters it has for scans, and what is found at one place from
/// many of them is a feature. A grid is looked at through the outlines of its cells (see outlines_of), so
/// that corners lie better than a cell. Corners of a floor plan (for `corners` and `rdp`) are then put where
/// they are drawn.
///
/// Out: covariance is the scatter of the finds plus the map's own error. Errors: a field outside of its
/// range, a map without walls, no place to look from, nothing found; each names what else to try. Cost: views
/// x (a sweep + the detector), a second or two for a storey; deterministic.
Result<FeatureMap> build_feature_map(const Map& map, Detector detector,
                                     const PointFeaturesConfig& detecting = {},
                                     const FeatureMapConfig& config = {});

}  // namespace beaconless
