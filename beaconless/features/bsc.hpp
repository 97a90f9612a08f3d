// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"

namespace beaconless {

/// Binary Shape Context: a polar grid of 16 sectors x 8 rings around a keypoint, a bit a cell, set where a
/// beam ends. Ring r, sector s is bit 16 (r mod 4) + s of word r / 4; ring 0 is the inner one.
struct BscDescriptor {
  static constexpr int kSectors = 16;
  static constexpr int kRings = 8;

  std::array<std::uint64_t, 2> words{};

  bool cell(int ring, int sector) const {
    const int bit = ring * kSectors + sector;
    return ((words[static_cast<std::size_t>(bit / 64)] >> static_cast<unsigned>(bit % 64)) & 1U) != 0;
  }
  friend bool operator==(const BscDescriptor&, const BscDescriptor&) = default;
};

struct BscConfig {
  NeighbourhoodConfig neighbourhood;
  double inner_m = 0.02;  ///< nearer points have no direction to speak of
};

void describe(Fields& fields, BscConfig& config);

/// The largest distance() at which two descriptors count as of the same place: falkolib's 15 bits.
inline constexpr double kBscSame = 15.0 / 128.0;

/// Cells in which two descriptors differ, 0 … 128. A metric.
inline int hamming(const BscDescriptor& a, const BscDescriptor& b) {
  return std::popcount(a.words[0] ^ b.words[0]) + std::popcount(a.words[1] ^ b.words[1]);
}

/// hamming / 128, in [0, 1].
inline double distance(const BscDescriptor& a, const BscDescriptor& b) { return hamming(a, b) / 128.0; }

/// The descriptor turned counter-clockwise by whole sectors of 22.5°, either way: each ring rotates by
/// itself.
BscDescriptor rotated(const BscDescriptor& descriptor, int sectors);

/// Describes each keypoint by the cells in which beams end, one descriptor a keypoint, all zero where none
/// does.
///
/// In: keypoints in the sensor frame. The grid turns with their orientation, so that a turn of the sensor
/// changes nothing but what lies on borders of cells. A beam that is no hit adds nothing. Cost: beams within
/// the neighbourhood x a few vector operations; see bench/descriptor_bench. Source: Kallasi, Lodi Rizzini and
/// Caselli 2016. Differs: falkolib leaves turning to the caller, indexes one ring too far for points exactly
/// at the radius (here outside), keeps old cells when it computes anew, and its radius grows with range (here
/// an option). Sectors are centred on the orientation: a right angle's arms would lie on their borders.
std::vector<BscDescriptor> describe_bsc(const Scan& scan, std::span<const Keypoint> keypoints,
                                        const BscConfig& config = {});
void describe_bsc(const Scan& scan, std::span<const Keypoint> keypoints, const BscConfig& config,
                  std::vector<BscDescriptor>& out);

}  // namespace beaconless
