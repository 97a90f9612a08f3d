// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/map/map.hpp"
#include "beaconless/match/feature_map.hpp"
#include "beaconless/report/map_view.hpp"

namespace beaconless::report {

/// Draws a building with the features that it is known by, each with its orientation, and its covariance
/// where that is large enough to be seen. The colour tells which share of the views that see it find it.
///
/// In: map frame. Cost: O(cells + features).
Picture draw_feature_map(const Map& map, const FeatureMap& features, const MapViewConfig& config = {});

}  // namespace beaconless::report
