// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_contour.hpp"

namespace beaconless {
namespace {

/// Whether a stretch may go on from one beam to the next.
bool joined(const Scan& scan, std::size_t beam, std::size_t next, double max_gap_m) {
  if (!scan.is_hit(beam) || !scan.is_hit(next)) return false;
  return !(max_gap_m > 0.0) || (scan.point(next) - scan.point(beam)).squaredNorm() <= max_gap_m * max_gap_m;
}

void add(const Scan& scan, std::size_t beam, FlirtContour& contour) {
  contour.beam.push_back(static_cast<std::uint32_t>(beam));
  contour.range_m.push_back(scan.ranges_m()[beam]);
  contour.x_m.push_back(scan.x_m()[beam]);
  contour.y_m.push_back(scan.y_m()[beam]);
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
    const std::size_t before = size - halo % size;
    for (std::size_t k = 0; k < size + 2 * halo; ++k) add(scan, (before + k) % size, contour);
    contour.stretches.push_back({0, size + 2 * halo, halo, halo + size, true});
    return;
  }

  // 3. Otherwise stretch after stretch.
  std::size_t begin = 0;
  const auto finish = [&] {
    const std::size_t end = contour.size();
    if (end > begin) contour.stretches.push_back({begin, end, begin, end, false});
    begin = end;
  };
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t beam = (first + k) % size;
    if (k > 0 && !joined(scan, (beam + size - 1) % size, beam, max_gap_m)) finish();
    if (scan.is_hit(beam)) add(scan, beam, contour);
  }
  finish();
}

}  // namespace beaconless
