// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

int octant_of(double ux, double uy) {
  return (ux < 0.0 ? 1 : 0) | (uy < 0.0 ? 2 : 0) | (std::abs(uy) > std::abs(ux) ? 4 : 0);
}

int octant_at(const WallBeams& beams, std::size_t i) { return octant_of(beams.ux[i], beams.uy[i]); }

/// The last block of lanes of those from `first` on, up to `last`, that begins in the same octant as `first`.
std::size_t end_of_octant(const WallBeams& beams, std::size_t first, std::size_t last, std::size_t width) {
  const int octant = octant_at(beams, first);
  if (octant_at(beams, last) == octant) return last + 1;
  std::size_t within = first;
  std::size_t beyond = last;
  while (beyond - within > 1) {
    const std::size_t middle = (within + beyond) / 2;
    (octant_at(beams, middle) == octant ? within : beyond) = middle;
  }
  return std::min((beyond + width - 1) / width * width, last + 1);
}

/// What a loop added between two marks, lane by lane.
struct Between {
  const WallMarks::Lanes* before = nullptr;
  const WallMarks::Lanes* after = nullptr;

  double of(std::size_t sum, std::size_t lane) const {
    return (*after)[sum * WallBeams::kLanes + lane] -
           (before == nullptr ? 0.0 : (*before)[sum * WallBeams::kLanes + lane]);
  }
};

void add_lane(const Between& between, std::size_t lane, PartialSums& sums) {
  for (std::size_t k = 0; k < 6; ++k) sums.hessian[k] += between.of(k, lane);
  for (std::size_t k = 0; k < 3; ++k) sums.gradient[k] += between.of(6 + k, lane);
}

}  // namespace

void divide(const WallBeams& beams, VectorLoop loop, WallMarks& marks, std::vector<WallPiece>& pieces) {
  const std::size_t width = loop == VectorLoop::avx2 ? 4 : 2;
  marks.width = width;
  marks.at.clear();
  pieces.clear();
  const auto mark = [&](std::size_t at) {
    if (at > 0 && (marks.at.empty() || marks.at.back() < at))
      marks.at.push_back(static_cast<std::uint32_t>(at));
  };
  for (std::size_t k = 0; k < beams.start_count; ++k) {
    const std::size_t end = k + 1 < beams.start_count ? beams.starts[k + 1] : beams.count;
    for (std::size_t first = beams.starts[k]; first < end;) {
      const std::size_t next = end_of_octant(beams, first, end - 1, width);
      pieces.push_back({beams.nx[first],
                        beams.ny[first],
                        beams.offset_m[first],
                        octant_at(beams, first),
                        static_cast<std::uint32_t>(next),
                        {}});
      // Lanes that two pieces share are left by themselves.
      mark(next / width * width);
      mark((next + width - 1) / width * width);
      first = next;
    }
  }
  marks.lanes.resize(std::max(marks.lanes.size(), marks.at.size()));
}

void add_up(const WallMarks& marks, std::vector<WallPiece>& pieces) {
  std::size_t piece = 0;
  std::size_t from = 0;
  Between between;
  for (std::size_t k = 0; k < marks.at.size(); ++k) {
    between.after = &marks.lanes[k];
    for (std::size_t lane = 0; lane < marks.width; ++lane) {
      while (piece + 1 < pieces.size() && from + lane >= pieces[piece].end) ++piece;
      add_lane(between, lane, pieces[piece].sums);
    }
    from = marks.at[k];
    between.before = between.after;
  }
}

}  // namespace beaconless
