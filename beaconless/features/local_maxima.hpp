// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/features/keypoint.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// Keeps those keypoints of a scan, given in the order of their beams, that no better one lies within
/// `radius_m` of; of equal ones the first. The order stays; `candidates` is a buffer.
///
/// Equal ones that lie further apart are all kept. Source: Kallasi et al. 2016, section III-C.
/// Differs: the public FALKO code takes any run of equal scores for one plateau, however far apart, and so
/// loses corners of symmetric rooms. Cost: keypoints x those within the radius; allocates nothing once grown.
void keep_local_maxima(const Scan& scan, double radius_m, std::vector<Keypoint>& keypoints,
                       std::vector<Keypoint>& candidates);

}  // namespace beaconless
