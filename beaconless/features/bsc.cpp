// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/bsc.hpp"

#include "beaconless/features/descriptor_cells.hpp"

namespace beaconless {
namespace {

using Cells = PolarCells<BscDescriptor::kSectors, BscDescriptor::kRings>;

constexpr double kHalfSector_rad = kPi / BscDescriptor::kSectors;

BscDescriptor describe_one(const Scan& scan, const Keypoint& keypoint, const BscConfig& config) {
  const double radius_m = config.neighbourhood.radius_at(keypoint.point.norm());
  const Cells cells(keypoint, config.inner_m, radius_m, -kHalfSector_rad);
  std::uint64_t low = 0;
  std::uint64_t high = 0;
  cells.for_each_hit(scan, beams_around(scan, keypoint.point, radius_m), [&](std::int32_t cell) {
    const auto at = static_cast<std::uint32_t>(cell);
    const std::uint64_t bit = std::uint64_t{1} << (at % 64U);
    low |= at < 64U ? bit : 0U;
    high |= at / 64U == 1U ? bit : 0U;  // what lies outside has 2
  });
  return {{low, high}};
}

}  // namespace

void describe(Fields& fields, BscConfig& config) {
  fields.section("neighbourhood", config.neighbourhood);
  fields("inner_m", config.inner_m, {0.0, 10.0},
         "beams that end nearer to the keypoint than this do not count");
}

BscDescriptor rotated(const BscDescriptor& descriptor, int sectors) {
  const auto by = static_cast<unsigned>(((sectors % 16) + 16) % 16);
  BscDescriptor turned;
  for (std::size_t w = 0; w < 2; ++w)
    for (unsigned shift = 0; shift < 64U; shift += 16U) {
      const auto ring = static_cast<std::uint16_t>(descriptor.words[w] >> shift);
      turned.words[w] |= static_cast<std::uint64_t>(std::rotl(ring, static_cast<int>(by))) << shift;
    }
  return turned;
}

std::vector<BscDescriptor> describe_bsc(const Scan& scan, std::span<const Keypoint> keypoints,
                                        const BscConfig& config) {
  std::vector<BscDescriptor> out;
  describe_bsc(scan, keypoints, config, out);
  return out;
}

void describe_bsc(const Scan& scan, std::span<const Keypoint> keypoints, const BscConfig& config,
                  std::vector<BscDescriptor>& out) {
  out.clear();
  out.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) out.push_back(describe_one(scan, keypoint, config));
}

}  // namespace beaconless
