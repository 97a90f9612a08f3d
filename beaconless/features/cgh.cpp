// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/cgh.hpp"

#include "beaconless/features/descriptor_cells.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kBins = CghDescriptor::kBins;
constexpr double kHalfBin_rad = kPi / CghDescriptor::kBins;

CghDescriptor describe_one(const Scan& scan, const Keypoint& keypoint, const CghConfig& config) {
  // 1. Count the beams a bin; what lies outside falls into one bin more.
  const double radius_m = config.neighbourhood.radius_at(keypoint.point.norm());
  const PolarCells<CghDescriptor::kBins, 1> cells(keypoint, config.inner_m, radius_m, -kHalfBin_rad);
  std::array<int, kBins + 1> counts{};
  int inside = 0;
  cells.for_each_hit(scan, beams_around(scan, keypoint.point, radius_m),
                     [&counts](std::int32_t bin) { ++counts[static_cast<std::size_t>(bin)]; });
  for (std::size_t bin = 0; bin < kBins; ++bin) inside += counts[bin];

  // 2. Blur round the circle, 3. normalise.
  CghDescriptor descriptor;
  if (inside == 0) {
    descriptor.bins.fill(1.0F / kBins);
    return descriptor;
  }
  const float unit = 1.0F / (7.0F * static_cast<float>(inside));
  for (std::size_t bin = 0; bin < kBins; ++bin)
    descriptor.bins[bin] = unit * static_cast<float>(5 * counts[bin] + counts[(bin + 1) % kBins] +
                                                     counts[(bin + kBins - 1) % kBins]);
  return descriptor;
}

}  // namespace

void describe(Fields& fields, CghConfig& config) {
  fields.section("neighbourhood", config.neighbourhood);
  fields("inner_m", config.inner_m, {0.0, 10.0},
         "beams that end nearer to the keypoint than this do not count");
}

CghDescriptor rotated(const CghDescriptor& descriptor, int bins) {
  constexpr int kAll = CghDescriptor::kBins;
  CghDescriptor turned;
  for (int k = 0; k < kAll; ++k)
    turned.bins[static_cast<std::size_t>((((k + bins) % kAll) + kAll) % kAll)] =
        descriptor.bins[static_cast<std::size_t>(k)];
  return turned;
}

std::vector<CghDescriptor> describe_cgh(const Scan& scan, std::span<const Keypoint> keypoints,
                                        const CghConfig& config) {
  std::vector<CghDescriptor> out;
  describe_cgh(scan, keypoints, config, out);
  return out;
}

void describe_cgh(const Scan& scan, std::span<const Keypoint> keypoints, const CghConfig& config,
                  std::vector<CghDescriptor>& out) {
  out.clear();
  out.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) out.push_back(describe_one(scan, keypoint, config));
}

}  // namespace beaconless
