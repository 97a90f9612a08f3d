// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/beam_neighbourhoods.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// How well a neighbourhood is a corner.
enum class OcScore : int {
  explained,  ///< share of the neighbours that lie on the two arms, in [0, 1]
  balance,    ///< as in falkolib: arms of equal length, without an upper limit
};

/// The orthogonal-corner detector; the defaults are this project's, see oc_preset() for those of others.
struct OcConfig {
  double range_min_m = 0.0;
  double range_max_m = 30.0;
  KeypointRadius radius{.at_zero_m = 0.25, .growth_per_m = 0.07};
  double tolerance_m = 0.03;
  int min_points = 2;
  OcScore score = OcScore::explained;
  double min_score = 0.8;
  double nms_radius_m = 0.25;
};

void describe(Fields& fields, OcConfig& config);

/// The parameters of "beaconless" (the defaults) or "authors" (falkolib's, with which it finds next to
/// nothing at 0.25° a beam: see docs/concepts/features.md); an Error for any other name.
Result<OcConfig> oc_preset(std::string_view name);

/// Buffers that live on from call to call.
struct OcScratch {
  BeamNeighbourhoods around;
  double direction_rad = 0.0;  ///< the dominant direction found
  std::vector<float> x_m;      ///< the unrolled points, turned so that walls run along the axes
  std::vector<float> y_m;
  std::vector<Keypoint> candidates;
};

/// Finds right-angled corners of walls that run along or across the scan's dominant direction.
///
/// In: a scan. Out: keypoints by beam: point is where the arms meet, orientation the bisector between them,
/// scale the radius of the neighbourhood. Cost: see docs/performance.md; allocates nothing with the scratch
/// of a scan of the same size.
///
/// Source: the OC detector of falkolib (Kallasi, Lodi Rizzini and Caselli); dissertation 3.3.1. Differs:
/// (1) the window of a neighbourhood follows from the scan's angle step, not from a constant 0.5°; (2) the
/// dominant direction: see dominant_direction(); (3) nothing is carried over from beam to beam; (4) only
/// neighbourhoods that are triangles are looked at (a quarter of the radius high), which straight walls are
/// not; (5) the default score counts neighbours off the arms against the corner, and the tolerance is three
/// sigmas of a usual scanner, where the library's 0.1 m leaves arms of next to no length.
std::vector<Keypoint> detect_oc(const Scan& scan, const OcConfig& config = {});
void detect_oc(const Scan& scan, const OcConfig& config, OcScratch& scratch,
               std::vector<Keypoint>& keypoints);

}  // namespace beaconless
