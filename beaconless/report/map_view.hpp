// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/report/map_marks.hpp"
#include "beaconless/report/picture.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::report {

/// A scan, and where its laser stood in the map.
struct PlacedScan {
  Scan scan;
  Pose2 map_from_laser;
};

struct MapViewConfig {
  double width_px = 1000.0;
  double max_height_px = 860.0;
  double ellipse_sigma_count =
      3.0;  ///< of the covariance ellipses, drawn where they are large enough to be seen
  std::size_t max_pixels = 2'000'000;         ///< of a grid map's image
  std::size_t max_scan_points = 120'000;      ///< of all scans; more are thinned evenly
  std::optional<Eigen::AlignedBox2d> window;  ///< the part of the map that is shown, instead of all of it
};

/// Draws the building, the path through it in the colours of its statuses, the reference as a wide pale line
/// below it, and scans laid over the walls; axes in metres at one scale, with a scale bar.
///
/// The picture shows all walls, and the path as far as it stays near them; a note counts what lies outside.
/// In: map frame everywhere; any span may be empty. Cost: O(cells + poses + beams).
Picture draw_map(const Map& map, std::span<const PoseEstimate> estimates, const Trajectory& reference = {},
                 std::span<const PlacedScan> scans = {}, const MapViewConfig& config = {});

/// The same with marks on top of all.
Picture draw_map(const Map& map, std::span<const PoseEstimate> estimates, const Trajectory& reference,
                 std::span<const PlacedScan> scans, std::span<const MapMarks> marks,
                 const MapViewConfig& config);

}  // namespace beaconless::report
