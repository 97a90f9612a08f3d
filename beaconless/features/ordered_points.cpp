// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/ordered_points.hpp"

#include <algorithm>

namespace beaconless {
namespace {

constexpr std::size_t kBefore = 16;  // beams before the first segment, so that its begin may move back

std::span<const float> turned(std::span<const float> beams, std::size_t first, std::size_t size,
                              std::vector<float>& buffer) {
  buffer.clear();
  buffer.reserve(size);
  while (buffer.size() < size) {
    const std::size_t count = std::min(beams.size() - first, size - buffer.size());
    const auto from = beams.begin() + static_cast<std::ptrdiff_t>(first);
    buffer.insert(buffer.end(), from, from + static_cast<std::ptrdiff_t>(count));
    first = 0;
  }
  return buffer;
}

}  // namespace

OrderedPoints ordered_points(const Scan& scan, std::span<const ScanSegment> segments,
                             OrderedPointsScratch& scratch) {
  const std::size_t n = scan.size();
  if (!scan.is_full_circle() || segments.empty())
    return {.x_m = scan.x_m(), .y_m = scan.y_m(), .ranges_m = scan.ranges_m(), .beam_count = n};
  const std::size_t before = std::min(kBefore, n - 1);
  const std::size_t first = (segments.front().first + n - before) % n;
  const std::size_t size = 2 * n + before;
  return {.x_m = turned(scan.x_m(), first, size, scratch.x_m),
          .y_m = turned(scan.y_m(), first, size, scratch.y_m),
          .ranges_m = turned(scan.ranges_m(), first, size, scratch.ranges_m),
          .beam_count = n,
          .first_beam = first,
          .first_place = before,
          .is_circle = true};
}

}  // namespace beaconless
