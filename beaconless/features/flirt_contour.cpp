// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_contour.hpp"

#include <algorithm>
#include <span>

namespace beaconless {
namespace {

/// Whether a stretch may go on from one beam to the next.
bool joined(const Scan& scan, std::size_t beam, std::size_t next, double max_gap_m) {
  if (!scan.is_hit(beam) || !scan.is_hit(next)) return false;
  return !(max_gap_m > 0.0) || (scan.point(next) - scan.point(beam)).squaredNorm() <= max_gap_m * max_gap_m;
}

/// Adds beams [begin, end).
void add(const Scan& scan, std::size_t begin, std::size_t end, FlirtContour& contour) {
  const auto append = [&](std::span<const float> from, std::vector<float>& to) {
    const auto beams = from.subspan(begin, end - begin);
    to.insert(to.end(), beams.begin(), beams.end());
  };
  append(scan.ranges_m(), contour.range_m);
  append(scan.x_m(), contour.x_m);
  append(scan.y_m(), contour.y_m);
  for (std::size_t beam = begin; beam < end; ++beam) contour.beam.push_back(static_cast<std::uint32_t>(beam));
}

void clear(FlirtContour& contour, std::size_t capacity) {
  contour.beam.clear();
  contour.range_m.clear();
  contour.x_m.clear();
  contour.y_m.clear();
  contour.stretches.clear();
  contour.beam.reserve(capacity);
  contour.range_m.reserve(capacity);
  contour.x_m.reserve(capacity);
  contour.y_m.reserve(capacity);
}

}  // namespace

void gather_contour(const Scan& scan, double max_gap_m, std::size_t halo, FlirtContour& contour) {
  const std::size_t size = scan.size();
  clear(contour, size + 2 * halo);

  // 1. Where to begin: behind a gap, if the scan is a circle and has one.
  std::size_t first = 0;
  bool closed = false;
  if (scan.is_full_circle()) {
    while (first < size && joined(scan, (first + size - 1) % size, first, max_gap_m)) ++first;
    closed = first == size;
    if (closed) first = 0;
  }

  // 2. A circle without a gap: once around, with a halo on both sides.
  if (closed) {
    std::size_t beam = size - halo % size;
    for (std::size_t left = size + 2 * halo; left > 0;) {
      beam %= size;
      const std::size_t count = std::min(left, size - beam);
      add(scan, beam, beam + count, contour);
      beam += count;
      left -= count;
    }
    contour.stretches.push_back({0, size + 2 * halo, halo, halo + size, true});
    return;
  }

  // 3. Otherwise stretch after stretch; one that runs over the end of the arrays comes in two parts.
  std::size_t begin = 0;  // of the stretch in the contour
  std::size_t from = 0;   // the beams [first + from, first + k) are hits that are still to be added
  const auto add_until = [&](std::size_t k) {
    const std::size_t a = first + from;
    const std::size_t b = first + k;
    if (a < size) add(scan, a, std::min(b, size), contour);
    if (b > size) add(scan, std::max(a, size) - size, b - size, contour);
    if (const std::size_t end = contour.size(); end > begin) {
      contour.stretches.push_back({begin, end, begin, end, false});
      begin = end;
    }
  };
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t beam = first + k < size ? first + k : first + k - size;
    if (k > from && !joined(scan, beam == 0 ? size - 1 : beam - 1, beam, max_gap_m)) {
      add_until(k);
      from = k;
    }
    if (!scan.is_hit(beam)) from = k + 1;
  }
  if (size > from) add_until(size);
}

}  // namespace beaconless
