// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "beaconless/features/descriptor_distance.hpp"
#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"

namespace beaconless {

/// Beta grid: how sure each cell of a polar grid of 4 rings x 12 sectors is occupied; sums to 1. Ring r,
/// sector s is cell 12 r + s; sector 0 begins at the keypoint's orientation.
struct BetaGrid {
  static constexpr int kSectors = 12;
  static constexpr int kRings = 4;
  static constexpr int kCells = kSectors * kRings;

  std::array<float, kCells> cells{};

  friend bool operator==(const BetaGrid&, const BetaGrid&) = default;
};

struct BetaGridConfig {
  NeighbourhoodConfig neighbourhood;
  double inner_m = 0.02;   ///< where the first ring begins
  double margin_m = 0.03;  ///< the last piece of a beam, within the noise of its wall, is not free space
};

void describe(Fields& fields, BetaGridConfig& config);

/// The largest distance() at which two descriptors count as of the same place, as in flirtlib.
inline constexpr double kBetaGridSame = 0.4;

/// Symmetric chi-square, in [0, 1].
inline double distance(const BetaGrid& a, const BetaGrid& b) {
  return symmetric_chi_square(a.cells, b.cells);
}

/// What the beams say about each cell before it becomes a descriptor.
struct BetaGridCounts {
  std::array<int, BetaGrid::kCells> hits{};    ///< beams that end in the cell
  std::array<int, BetaGrid::kCells> misses{};  ///< beams that pass through it and end elsewhere

  friend bool operator==(const BetaGridCounts&, const BetaGridCounts&) = default;
};

/// Counts hits and misses around one keypoint.
///
/// Each beam is cut by the rings once; between two cuts it sweeps from one sector to another and passes all
/// between. Cost: the beams that pass within the radius x at most 9 pieces.
BetaGridCounts count_beta_grid(const Scan& scan, const Keypoint& keypoint, const BetaGridConfig& config = {});

/// Describes each keypoint by hits / (hits + misses) a cell, ½ where no beam came, scaled to sum to 1;
/// uniform where every cell is free. One descriptor a keypoint.
///
/// In: keypoints in the sensor frame; the grid turns with their orientation. A beam without return passes
/// through everything; one too close or invalid says nothing. Source: Tipaldi and Arras 2010, section III-B.
/// Differs: flirtlib tests every beam against every cell grown by 5 cm and 5°, and against a window of beams
/// that is too narrow; its crossing test has a wrong product. Here cells are exact, the noise of a wall is
/// kept out by margin_m, and beams without return are used.
std::vector<BetaGrid> describe_beta_grid(const Scan& scan, std::span<const Keypoint> keypoints,
                                         const BetaGridConfig& config = {});
void describe_beta_grid(const Scan& scan, std::span<const Keypoint> keypoints, const BetaGridConfig& config,
                        std::vector<BetaGrid>& out);

}  // namespace beaconless
