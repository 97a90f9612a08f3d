// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/interest_regions.hpp"

namespace beaconless {
namespace {

/// Marks the hits within the radius of one keypoint.
void mark(const Scan& scan, const Keypoint& keypoint, double radius_m, std::vector<std::uint8_t>& mask) {
  const auto range_m = scan.ranges_m();
  const auto x_m = scan.x_m();
  const auto y_m = scan.y_m();
  const auto x = static_cast<float>(keypoint.point.x());
  const auto y = static_cast<float>(keypoint.point.y());
  const auto square = static_cast<float>(radius_m * radius_m);
  const BeamWindow window = beams_around(scan, keypoint.point, radius_m);
  for (const ScanSegment& run : window.runs)
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      const float dx = x_m[i] - x;
      const float dy = y_m[i] - y;
      const auto is_hit = static_cast<std::uint8_t>(range_m[i] > 0.0F);
      const auto is_near = static_cast<std::uint8_t>(dx * dx + dy * dy <= square);
      mask[i] |= is_hit & is_near;
    }
}

}  // namespace

void describe(Fields& fields, InterestRegionsConfig& config) {
  fields.section("neighbourhood", config.neighbourhood);
}

InterestRegions find_interest_regions(const Scan& scan, std::span<const Keypoint> keypoints,
                                      const InterestRegionsConfig& config) {
  InterestRegions out;
  find_interest_regions(scan, keypoints, config, out);
  return out;
}

void find_interest_regions(const Scan& scan, std::span<const Keypoint> keypoints,
                           const InterestRegionsConfig& config, InterestRegions& out) {
  out.segments.clear();
  out.beams.clear();
  out.mask.assign(scan.size(), 0);
  out.beams.reserve(scan.size());
  out.segments.reserve(scan.size() / 2 + 1);

  // 1. Mark what is near, so that overlaps merge by themselves.
  for (const Keypoint& keypoint : keypoints)
    mark(scan, keypoint, config.neighbourhood.radius_at(keypoint.point.norm()), out.mask);

  // 2. Read the runs off the mask.
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (out.mask[i] == 0) continue;
    out.beams.push_back(i);
    const bool goes_on = i > 0 && out.mask[i - 1] != 0;
    if (goes_on) ++out.segments.back().count;
    if (!goes_on) out.segments.push_back({i, 1});
  }

  // 3. On a full circle the last run goes on as the first.
  const bool meets =
      out.segments.size() > 1 && scan.is_full_circle() && out.mask.front() != 0 && out.mask.back() != 0;
  if (meets) {
    out.segments.back().count += out.segments.front().count;
    out.segments.erase(out.segments.begin());
  }
}

}  // namespace beaconless
