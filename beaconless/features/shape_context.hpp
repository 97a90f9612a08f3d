// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "beaconless/features/descriptor_distance.hpp"
#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"

namespace beaconless {

/// Shape context: the share of the beams around a keypoint that end in each cell of a polar grid of 4 rings x
/// 12 sectors; sums to 1. Ring r, sector s is cell 12 r + s; sector 0 begins at the keypoint's orientation.
struct ShapeContext {
  static constexpr int kSectors = 12;
  static constexpr int kRings = 4;
  static constexpr int kCells = kSectors * kRings;

  std::array<float, kCells> cells{};

  friend bool operator==(const ShapeContext&, const ShapeContext&) = default;
};

struct ShapeContextConfig {
  NeighbourhoodConfig neighbourhood;
  double inner_m = 0.02;  ///< where the first ring begins
};

void describe(Fields& fields, ShapeContextConfig& config);

/// The largest distance() at which two descriptors count as of the same place, as in flirtlib.
inline constexpr double kShapeContextSame = 0.4;

/// Symmetric chi-square, in [0, 1].
inline double distance(const ShapeContext& a, const ShapeContext& b) {
  return symmetric_chi_square(a.cells, b.cells);
}

/// Describes each keypoint by where the beams around it end, one descriptor a keypoint, uniform where none
/// does.
///
/// In: keypoints in the sensor frame; the grid turns with their orientation. Rings are of equal width, as in
/// flirtlib, not logarithmic. A beam that is no hit adds nothing. Cost: as describe_bsc. Source: Belongie,
/// Malik and Puzicha 2002; Tipaldi and Arras 2010.
std::vector<ShapeContext> describe_shape_context(const Scan& scan, std::span<const Keypoint> keypoints,
                                                 const ShapeContextConfig& config = {});
void describe_shape_context(const Scan& scan, std::span<const Keypoint> keypoints,
                            const ShapeContextConfig& config, std::vector<ShapeContext>& out);

}  // namespace beaconless
