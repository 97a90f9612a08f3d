// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/nearest_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace beaconless {
namespace {

constexpr std::int32_t kNone = -1;

/// The lower envelope of parabolas (q - center)² + height along one row.
class Envelope {
 public:
  explicit Envelope(std::size_t capacity) : parabolas_(capacity), from_(capacity + 1) {}

  void clear() { count_ = 0; }

  void add(double center, double height, std::int32_t seed) {
    double begin = -std::numeric_limits<double>::infinity();
    while (count_ > 0) {
      const Parabola& last = parabolas_[count_ - 1];
      begin = ((height + center * center) - (last.height + last.center * last.center)) /
              (2.0 * (center - last.center));
      if (begin > from_[count_ - 1]) break;
      --count_;
      begin = -std::numeric_limits<double>::infinity();
    }
    parabolas_[count_] = {center, height, seed};
    from_[count_++] = begin;
  }

  /// Visits q = 0 … size - 1 with the seed and value of the lowest parabola there.
  template <class Visit>
  void sweep(int size, Visit visit) const {
    if (count_ == 0) return;
    std::size_t k = 0;
    for (int q = 0; q < size; ++q) {
      while (k + 1 < count_ && from_[k + 1] < q) ++k;
      const double d = q - parabolas_[k].center;
      visit(q, parabolas_[k].seed, d * d + parabolas_[k].height);
    }
  }

 private:
  struct Parabola {
    double center = 0.0;
    double height = 0.0;
    std::int32_t seed = kNone;
  };
  std::vector<Parabola> parabolas_;
  std::vector<double> from_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<std::int32_t> nearest_seeds(int width, int height, std::span<const std::int32_t> seeds,
                                        double reach_cells) {
  const auto columns = static_cast<std::size_t>(width);
  std::vector<std::int32_t> nearest(columns * static_cast<std::size_t>(height), kNone);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    nearest[static_cast<std::size_t>(seeds[i])] = static_cast<std::int32_t>(i);

  // 1. Down and up each column: the nearest seed of the same column.
  for (std::size_t x = 0; x < columns; ++x) {
    std::int32_t last = kNone;
    for (int y = 0; y < height; ++y) {
      auto& cell = nearest[static_cast<std::size_t>(y) * columns + x];
      if (cell == kNone) cell = last;
      last = cell;
    }
    last = kNone;
    for (int y = height - 1; y >= 0; --y) {
      auto& cell = nearest[static_cast<std::size_t>(y) * columns + x];
      const auto away = [&](std::int32_t seed) {
        return seed == kNone ? std::numeric_limits<int>::max()
                             : std::abs(seeds[static_cast<std::size_t>(seed)] / width - y);
      };
      if (away(last) < away(cell)) cell = last;
      last = cell;
    }
  }
  // 2. Along each row: the lower envelope of what the columns offer.
  Envelope envelope(columns);
  for (int y = 0; y < height; ++y) {
    auto* row = &nearest[static_cast<std::size_t>(y) * columns];
    envelope.clear();
    for (int x = 0; x < width; ++x) {
      if (row[x] == kNone) continue;
      const int seed_y = seeds[static_cast<std::size_t>(row[x])] / width;
      const double dy = seed_y - y;
      if (std::abs(dy) <= reach_cells) envelope.add(x, dy * dy, row[x]);
    }
    std::fill(row, row + width, kNone);
    envelope.sweep(width, [&](int x, std::int32_t seed, double square) {
      if (square <= reach_cells * reach_cells) row[x] = seed;
    });
  }
  return nearest;
}

}  // namespace beaconless
