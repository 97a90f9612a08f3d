// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/unrolled_scan.hpp"

#include <algorithm>
#include <span>

namespace beaconless {

void UnrolledScan::assign(const Scan& scan, std::size_t pad) {
  beams_ = scan.size();
  pad_ = pad;
  const std::size_t places = beams_ + 2 * pad_;
  x_m.resize(places);
  y_m.resize(places);
  run_first.resize(places);
  run_last.resize(places);

  // 1. points: zeros, or the beams of the other end
  const bool round = scan.is_full_circle();
  const auto lay_out = [&](std::span<const float> from, std::vector<float>& to) {
    std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(pad_));
    for (std::size_t k = 0; k < pad_; ++k) {  // where there are few beams, they come more than once
      to[pad_ - 1 - k] = round ? from[beams_ - 1 - k % beams_] : 0.0F;
      to[pad_ + beams_ + k] = round ? from[k % beams_] : 0.0F;
    }
  };
  lay_out(scan.x_m(), x_m);
  lay_out(scan.y_m(), y_m);

  // 2. runs of hits, and the empty ones of places without a hit
  const auto hits = [this](std::size_t place) { return x_m[place] != 0.0F || y_m[place] != 0.0F; };
  for (std::size_t first = 0; first < places;) {
    if (!hits(first)) {
      run_first[first] = static_cast<std::uint32_t>(first + 1);
      run_last[first] = static_cast<std::uint32_t>(first) - 1;
      ++first;
      continue;
    }
    std::size_t after = first + 1;
    while (after < places && hits(after)) ++after;
    const auto length = static_cast<std::ptrdiff_t>(after - first);
    const auto from = static_cast<std::ptrdiff_t>(first);
    std::fill_n(run_first.begin() + from, length, static_cast<std::uint32_t>(first));
    std::fill_n(run_last.begin() + from, length, static_cast<std::uint32_t>(after - 1));
    first = after;
  }
}

}  // namespace beaconless
