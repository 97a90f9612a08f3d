// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "beaconless/features/circles.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/report/picture.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::report {

/// Keypoints of one detector, drawn in one colour.
struct KeypointLayer {
  std::string name;
  std::vector<Keypoint> keypoints;
  Colour colour = Colour::blue;
};

/// What was found in a scan. Anything may be empty.
struct ScanLayers {
  std::vector<ScanSegment> segments;  ///< their beams take turns in five colours; other hits are grey
  std::vector<ScanLine> lines;
  std::vector<Corner> corners;
  std::vector<ScanCircle> circles;
  std::vector<KeypointLayer> keypoints;
};

struct ScanViewConfig {
  double width_px = 1000.0;
  double max_height_px = 860.0;
  double ellipse_sigma_count = 3.0;  ///< of the corners' covariances
};

/// Draws a scan in its own frame, x up and the sensor marked, with what was found in it: segments in colours,
/// lines, corners with their covariance ellipses and bisectors, keypoints with their orientations and scales.
///
/// Cost: O(beams + features).
Picture draw_scan(const Scan& scan, const ScanLayers& layers, const ScanViewConfig& config = {});

}  // namespace beaconless::report
