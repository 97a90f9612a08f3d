// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/features/falko.hpp"
#include "beaconless/features/flirt.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/oc.hpp"
#include "beaconless/features/vertices.hpp"

namespace beaconless {

/// What finds points in a scan, by the names that users type.
enum class Detector : int { corners, falko, oc, flirt_range, flirt_blob, flirt_edge, flirt_curvature, rdp };

/// A detector's name and what it finds, for lists and help.
struct DetectorName {
  Detector detector;
  std::string_view name;
  std::string_view sentence;
};

/// All detectors, in the order of the enumeration.
std::span<const DetectorName> detectors();

std::string_view to_string(Detector detector);

/// The detector of that name; an Error that suggests the nearest one for any other.
Result<Detector> detector_named(std::string_view name);

/// The parameters of all detectors.
struct DetectorsConfig {
  CornersConfig corners;
  FalkoConfig falko;
  OcConfig oc;
  FlirtConfig flirt_range = flirt_defaults(FlirtKind::range);
  FlirtConfig flirt_blob = flirt_defaults(FlirtKind::normal_blob);
  FlirtConfig flirt_edge = flirt_defaults(FlirtKind::normal_edge);
  FlirtConfig flirt_curvature = flirt_defaults(FlirtKind::curvature);
  VerticesConfig rdp;
};

void describe(Fields& fields, DetectorsConfig& config);

/// The parameters of "beaconless" (the defaults), "authors" (those of the public libraries: falkolib, and
/// flirtlib's tools) or "dissertation" (chapter 3.1 and Table 4.10; what it does not tell is the authors');
/// an Error for any other name.
Result<DetectorsConfig> detectors_preset(std::string_view name);

/// Buffers that live on from scan to scan.
struct DetectorScratch {
  CornersScratch corners;
  std::vector<Corner> found_corners;
  FalkoScratch falko;
  OcScratch oc;
  std::array<FlirtScratch, 4> flirt;  ///< one a kind, as each has kernels of its own
  VerticesScratch rdp;
};

/// Runs one detector. Corners come as keypoints: see keypoint_of(). Out: sensor frame, in the detector's
/// order.
std::vector<Keypoint> detect(const Scan& scan, Detector detector, const DetectorsConfig& config = {});
void detect(const Scan& scan, Detector detector, const DetectorsConfig& config, DetectorScratch& scratch,
            std::vector<Keypoint>& keypoints);

}  // namespace beaconless
