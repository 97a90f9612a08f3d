// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "beaconless/report/map_view.hpp"

/// The layers of a map view, from the paper up; each draws itself and says in the legend what it is.
namespace beaconless::report {

void draw_building(Picture& picture, const WorldView& view, const FloorPlan& plan,
                   const MapViewConfig& config);
void draw_building(Picture& picture, const WorldView& view, const OccupancyGrid& grid,
                   const MapViewConfig& config);

/// Hits of the scans as dots; those that fall on the same half pixel are drawn once.
void draw_scans(Picture& picture, const WorldView& view, std::span<const PlacedScan> scans,
                const MapViewConfig& config);

void draw_reference(Picture& picture, const WorldView& view, const Trajectory& reference);

/// The path in the colours of its statuses. Poses less than half a pixel apart are drawn as one, in the worst
/// colour.
void draw_estimates(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates);

/// A few covariance ellipses along the path, where they are large enough to be seen and small enough to mean
/// something.
void draw_ellipses(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates,
                   const MapViewConfig& config);

/// Where the path begins, with its heading, and where it ends.
void draw_ends(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates);

}  // namespace beaconless::report
