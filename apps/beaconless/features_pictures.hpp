// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "beaconless/features/detector.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::cli {

/// A scan with what the detectors find in it, one drawing a detector, as an SVG file. `name` is of the scan.
std::string features_picture(const Scan& scan, std::span<const Detector> wanted,
                             const DetectorsConfig& config, const std::string& name);

/// Figures 4.5 to 4.9 of the dissertation for a scan, as an SVG file: how many segments there are by distance
/// threshold and by epsilon, what they look like, and the corners that follow.
std::string sweep_picture(const Scan& scan, const DetectorsConfig& config, const std::string& name);

}  // namespace beaconless::cli
