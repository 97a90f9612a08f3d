// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/segment_runs.hpp"

#include <algorithm>
#include <cstring>

namespace beaconless {
namespace {

/// The next beam at or after `from` with a break; size() where there is none. Eight beams a step where all
/// goes on.
std::size_t next_break(std::span<const std::uint8_t> breaks, std::size_t from) {
  const std::size_t n = breaks.size();
  std::uint64_t eight = 0;
  for (; from + sizeof eight <= n; from += sizeof eight) {
    std::memcpy(&eight, breaks.data() + from, sizeof eight);
    if (eight != 0) break;
  }
  while (from < n && breaks[from] == 0) ++from;
  return from;
}

}  // namespace

void segments_from_breaks(const Scan& scan, std::span<const std::uint8_t> breaks, std::size_t min_beams,
                          std::vector<ScanSegment>& segments) {
  segments.clear();
  const std::size_t n = breaks.size();
  // 1. Begin after the first break of a full circle, so that what runs over the end is the last segment.
  std::size_t begin = 0;
  if (breaks[n - 1] == 0) {
    begin = next_break(breaks, 0) + 1;
    if (begin > n) {
      const auto ranges = scan.ranges_m();
      const auto farthest = std::max_element(ranges.begin(), ranges.end());
      if (n >= min_beams) segments.push_back({static_cast<std::size_t>(farthest - ranges.begin()), n});
      return;
    }
  }
  const std::size_t head = begin;  // the beams before it belong to the last run

  // 2. One run after the other.
  while (begin < n) {
    const std::size_t end = next_break(breaks, begin);
    const std::size_t count = end < n ? end - begin + 1 : n - begin + head;
    if (count >= min_beams && scan.is_hit(begin)) segments.push_back({begin, count});
    begin = end + 1;
  }
}

}  // namespace beaconless
