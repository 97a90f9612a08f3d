// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "beaconless/match/feature_pairs.hpp"
#include "beaconless/match/ransac_pairs.hpp"

namespace beaconless {

struct HoughConfig {
  double bin_rad = 0.02;    ///< about; a turn has a whole number of bins
  double shortest_m = 0.5;  ///< lines between features shorter than this have no direction to vote with
  int peaks = 5;            ///< headings that are tried
};

void describe(Fields& fields, HoughConfig& config);

/// Buffers of find_hough_pose().
struct HoughScratch {
  struct Bin {
    double votes = 0.0;
    double cos = 0.0;
    double sin = 0.0;
  };
  struct Shift {
    double x_m, y_m;
  };
  std::vector<Bin> bins;
  std::vector<Bin> smoothed;
  std::vector<std::size_t> peaks;
  std::vector<Shift> shifts;
};

/// Lets every two candidates that agree vote for a heading, and at the best headings every candidate for a
/// position; the pose with the best score (see score_pose). Nothing where no two agree.
///
/// Cost: candidates² / 2 agreement tests, then candidates a peak. Source: the Hough alignment of falkolib
/// (AHT). Differs: that votes in a cube of (x, y, heading) of 780 000 bins within 5 m and 90°, which it never
/// clears between calls, cuts towards zero below zero, takes the last of equal peaks and keeps pairs many to
/// one. Here headings come from the lines between features and wrap around; positions are found by density
/// and have no limits.
std::optional<PairsPose> find_hough_pose(const FeatureSet& first, const FeatureSet& second,
                                         std::span<const FeaturePair> candidates,
                                         const PairingConfig& pairing, const HoughConfig& config,
                                         HoughScratch& scratch);

}  // namespace beaconless
