// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/point_feature.hpp"
#include "beaconless/match/views_in_sight.hpp"

namespace beaconless {

/// A feature that was found from one of several places.
struct MapFind {
  PointFeature feature;  ///< map frame
  int view = 0;          ///< which of the places
  double range_m = 0.0;  ///< from there
};

/// On what a feature of a map rests.
struct FeatureEvidence {
  int found_views = 0;     ///< views of the map that it was found in; may be 0 for a corner that is drawn
  double share = 1.0;      ///< … of those that see its place from no farther than most; 1 for drawn corners
  double scatter_m = 0.0;  ///< root mean square distance of the finds from their mean
};

struct RepeatedFind {
  PointFeature feature;
  FeatureEvidence evidence;
};

/// The order of features by x, then y, then orientation.
bool is_left_of(const RepeatedFind& p, const RepeatedFind& q);

/// When finds from different places are one feature, and when that is one of the building.
struct RepeatedFindsConfig {
  double same_place_m = 0.10;   ///< finds within this distance of their mean …
  double same_turn_deg = 25.0;  ///< … that are turned alike are one feature
  int min_views = 3;            ///< features found in fewer views are left out …
  double min_share = 0.1;       ///< … or in a smaller share of those that see their place …
  double max_scatter_m = 0.04;  ///< … or whose finds are spread out further: they move with the view
};

void describe(Fields& fields, RepeatedFindsConfig& config);

/// Gathers what was found of the same thing from many places, and leaves out what only some of those see that
/// could see it or sees elsewhere: ends of shadows and backs of columns, which move with the place that they
/// are seen from. Finds spread evenly along a wall have a scatter of 0.58 same_place_m.
///
/// Out: position and covariance are mean and scatter of the finds without outliers, orientation and opening
/// their means; in the order of is_left_of. Cost: about finds x those within same_place_m, and a ray for each
/// feature and view near it. Source: modes of the finds' density by mean shift (Comaniciu and Meer 2002) with
/// a flat kernel.
std::vector<RepeatedFind> gather_repeated_finds(std::span<const MapFind> finds, const ViewsInSight& views,
                                                const RepeatedFindsConfig& config = {});

}  // namespace beaconless
