// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "beaconless/features/detector.hpp"
#include "beaconless/report/scan_view.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::cli {

/// A scan with what the detectors find in it, one drawing a detector, as an SVG file. `name` is of the scan.
std::string features_picture(const Scan& scan, std::span<const Detector> wanted,
                             const DetectorsConfig& config, const std::string& name);

/// Figures 4.5 and 4.8 of the dissertation for a scan: how many segments there are by distance threshold, and
/// how many pieces by epsilon of the split that follows.
report::Picture segments_by_threshold(const Scan& scan);
report::Picture pieces_by_epsilon(const Scan& scan);

/// Figures 4.6 and 4.7: a scan in segments, and in the pieces that a split makes of them.
report::Picture segments_picture(const Scan& scan, double threshold_m, const report::ScanViewConfig& view);
report::Picture pieces_picture(const Scan& scan, double epsilon_m, const report::ScanViewConfig& view);

/// Figure 4.9: the corners of a scan with the dissertation's parameters.
report::Picture dissertation_corners_picture(const Scan& scan, const report::ScanViewConfig& view);

/// Figures 4.5 to 4.9 of the dissertation for a scan, as an SVG file: how many segments there are by distance
/// threshold and by epsilon, what they look like, and the corners that follow.
std::string sweep_picture(const Scan& scan, const DetectorsConfig& config, const std::string& name);

}  // namespace beaconless::cli
