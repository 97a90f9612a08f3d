// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless::report {

/// A place where the robot may be.
struct CandidatePlace {
  Pose2 map_from_base;
  double score = 0.0;   ///< 0 … 1: share of the scan that is explained from there
  double weight = 0.0;  ///< 0 … 1: how likely it is this one
};

/// The places that fitted after a scan, the likeliest first.
struct CandidatePlaces {
  std::size_t scan_index = 0;  ///< counted from 0 in the recording
  Stamp stamp;
  std::vector<CandidatePlace> places;
  std::size_t place_count = 0;  ///< as many as there were, if not all are here
};

}  // namespace beaconless::report
