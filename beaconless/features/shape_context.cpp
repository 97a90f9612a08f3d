// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/shape_context.hpp"

#include "beaconless/features/descriptor_cells.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kCells = ShapeContext::kCells;

ShapeContext describe_one(const Scan& scan, const Keypoint& keypoint, const ShapeContextConfig& config) {
  // 1. Count the beams a cell; what lies outside falls into one cell more.
  const double radius_m = config.neighbourhood.radius_at(keypoint.point.norm());
  const PolarCells<ShapeContext::kSectors, ShapeContext::kRings> cells(keypoint, config.inner_m, radius_m,
                                                                       0.0);
  std::array<int, kCells + 1> counts{};
  int inside = 0;
  cells.for_each_hit(scan, beams_around(scan, keypoint.point, radius_m),
                     [&counts](std::int32_t cell) { ++counts[static_cast<std::size_t>(cell)]; });
  for (std::size_t cell = 0; cell < kCells; ++cell) inside += counts[cell];

  // 2. Normalise.
  ShapeContext descriptor;
  if (inside == 0) {
    descriptor.cells.fill(1.0F / kCells);
    return descriptor;
  }
  const float unit = 1.0F / static_cast<float>(inside);
  for (std::size_t cell = 0; cell < kCells; ++cell)
    descriptor.cells[cell] = unit * static_cast<float>(counts[cell]);
  return descriptor;
}

}  // namespace

void describe(Fields& fields, ShapeContextConfig& config) {
  fields.section("neighbourhood", config.neighbourhood);
  fields("inner_m", config.inner_m, {0.0, 10.0}, "where the first ring begins");
}

std::vector<ShapeContext> describe_shape_context(const Scan& scan, std::span<const Keypoint> keypoints,
                                                 const ShapeContextConfig& config) {
  std::vector<ShapeContext> out;
  describe_shape_context(scan, keypoints, config, out);
  return out;
}

void describe_shape_context(const Scan& scan, std::span<const Keypoint> keypoints,
                            const ShapeContextConfig& config, std::vector<ShapeContext>& out) {
  out.clear();
  out.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) out.push_back(describe_one(scan, keypoint, config));
}

}  // namespace beaconless
