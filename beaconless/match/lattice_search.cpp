// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/lattice_search.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <tuple>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/match/lattice_bounds.hpp"
#include "beaconless/match/share_work.hpp"

namespace beaconless {
namespace {

using Block = LatticeScratch::Block;
using Pyramid = NearnessPyramid;

constexpr int kTop = Pyramid::kLevels - 1;
constexpr int kFan = Pyramid::block_cells(1);        // blocks that a block consists of, to each side
constexpr int kSide = Pyramid::kTileColumns / kFan;  // blocks side by side that are one tile of smaller ones
constexpr int kWide = 20000;  // blocks of the top level, from which on they are too many for a heap
static_assert(kFan <= Pyramid::kTileRows && kFan <= Pyramid::kTileColumns);

/// Whether a block is to be looked at after another. Blocks come before single poses that cost the same, so
/// that of those the first is known when it is taken.
bool is_after(const Block& a, const Block& b) {
  if (a.cost != b.cost) return a.cost > b.cost;
  return std::tuple(-a.level, a.heading, a.y, a.x) > std::tuple(-b.level, b.heading, b.y, b.x);
}

/// One search: what is left of the lattice, and what was found so far.
class Search {
 public:
  Search(const LatticeBounds& bounds, const LatticeWish& wish, std::vector<std::vector<Block>>& blocks,
         std::vector<StartPose>& found)
      : bounds_(bounds),
        wish_(wish),
        blocks_(blocks),
        found_(found),
        hopeless_(static_cast<int>(wish.hopeless * bounds.worst())) {}

  void run() {
    // 1. Bounds for all of the lattice.
    bound_all();
    auto& blocks = blocks_.front();
    std::erase_if(blocks, [&](const Block& block) { return block.cost > limit(); });
    std::make_heap(blocks.begin(), blocks.end(), is_after);
    // 2. The block with the lowest bound into smaller ones, until it is a pose.
    while (!blocks.empty()) {
      std::pop_heap(blocks.begin(), blocks.end(), is_after);
      const Block block = blocks.back();
      blocks.pop_back();
      if (block.cost > limit()) break;
      if (is_covered(block)) continue;
      if (block.level == 0) {
        lower_best(block.cost);
        found_.push_back({bounds_.pose_of(block), static_cast<double>(block.cost) / bounds_.worst()});
        if (found_.size() == static_cast<std::size_t>(wish_.keep)) break;
        continue;
      }
      split(block, [&](const Block& part) {
        if (part.cost > limit() || is_covered(part)) return;
        blocks.push_back(part);
        std::push_heap(blocks.begin(), blocks.end(), is_after);
      });
    }
  }

 private:
  int limit() const { return best_.load(std::memory_order_relaxed) + hopeless_; }

  void lower_best(int cost) {
    int best = best_.load(std::memory_order_relaxed);
    while (cost < best && !best_.compare_exchange_weak(best, cost, std::memory_order_relaxed)) {
    }
  }

  template <class Visit>
  void split(const Block& block, const Visit& visit) const {
    bounds_.for_tile(block.level - 1, block.heading, block.x, block.y, kFan, kFan, limit(), visit);
  }

  /// The blocks of the top level in a tile that begins there.
  template <class Visit>
  void for_top_tile(int heading, int x, int y, const Visit& visit) const {
    bounds_.for_tile(kTop, heading, x, y, Pyramid::kTileColumns, Pyramid::kTileRows, limit(), visit);
  }

  /// Fills the first list of blocks with all that may hold what is wanted, or their parts.
  ///
  /// Whatever order headings are taken in, and whoever takes them: the limit that they are held against is
  /// never below that of the best pose there is.
  void bound_all() {
    blocks_.resize(static_cast<std::size_t>(std::max(1, wish_.threads)));
    for (auto& blocks : blocks_) blocks.clear();
    const int headings = bounds_.headings();
    const auto size = static_cast<double>(Pyramid::block_cells(kTop));
    const bool is_wide = (bounds_.columns() / size + 1.0) * (bounds_.rows() / size + 1.0) * headings > kWide;
    // 1. A few blocks as they are, from the middle heading outwards: what is near is likely to be good.
    if (!is_wide) {
      for (int k = 0; k < headings; ++k)
        cover(outwards(k), [&](const Block& block) { blocks_.front().push_back(block); });
      return;
    }
    // 2. Of many first a limit, then the parts that it leaves.
    share_work(headings, wish_.threads, [&](int k, std::size_t) { cover(outwards(k), [](const Block&) {}); });
    share_work(headings, wish_.threads,
               [&](int k, std::size_t worker) { cover_by_parts(outwards(k), blocks_[worker]); });
    for (std::size_t i = 1; i < blocks_.size(); ++i)
      blocks_[0].insert(blocks_[0].end(), blocks_[i].begin(), blocks_[i].end());
  }

  int outwards(int k) const { return bounds_.headings() / 2 + (k % 2 == 0 ? k / 2 : -(k + 1) / 2); }

  /// Visits all blocks of a heading. The best of them is followed down to a pose, as whose cost sets a limit.
  template <class Visit>
  void cover(int heading, const Visit& visit) {
    const int step = Pyramid::block_cells(kTop);
    Block best = none();
    for (int y = 0; y < bounds_.rows(); y += Pyramid::kTileRows * step)
      for (int x = 0; x < bounds_.columns(); x += Pyramid::kTileColumns * step)
        for_top_tile(heading, x, y, [&](const Block& block) {
          visit(block);
          if (block.cost < best.cost) best = block;
        });
    follow(best);
  }

  /// The parts of all blocks of a heading: of several blocks side by side at once, which is a tile of parts.
  void cover_by_parts(int heading, std::vector<Block>& parts) {
    const int step = Pyramid::block_cells(kTop);
    Block best = none();
    for (int y = 0; y < bounds_.rows(); y += Pyramid::kTileRows * step)
      for (int x = 0; x < bounds_.columns(); x += Pyramid::kTileColumns * step) {
        int last = -1;  // of the tiles of parts that were taken
        for_top_tile(heading, x, y, [&](const Block& block) {
          const int first_x = block.x - (block.x - x) % (kSide * step);
          const int tile = (block.y - y) / step * Pyramid::kTileColumns + (first_x - x) / step;
          if (tile == last) return;
          last = tile;
          bounds_.for_tile(kTop - 1, heading, first_x, block.y, Pyramid::kTileColumns, kFan, limit(),
                           [&](const Block& part) {
                             parts.push_back(part);
                             if (part.cost < best.cost) best = part;
                           });
        });
      }
    follow(best);
  }

  /// A block that is as good as the best pose so far.
  Block none() const { return {.cost = best_.load(std::memory_order_relaxed), .level = -1}; }

  /// Down to a pose by the best part of the best part.
  void follow(Block best) {
    while (best.level > 0) {
      Block least = none();
      split(best, [&](const Block& part) {
        if (part.cost < least.cost) least = part;
      });
      best = least;
    }
    if (best.level == 0) lower_best(best.cost);
  }

  /// Whether all its poses are neighbours of one that was found.
  bool is_covered(const Block& block) const {
    const int size = Pyramid::block_cells(block.level);
    const Pose2 first = bounds_.pose_of(block);
    const Pose2 last = bounds_.pose_of({0, 0, block.heading, block.x + size - 1, block.y + size - 1});
    return std::any_of(found_.begin(), found_.end(), [&](const StartPose& start) {
      const Pose2& found = start.map_from_laser;
      const double dx = std::max(std::abs(first.x_m - found.x_m), std::abs(last.x_m - found.x_m));
      const double dy = std::max(std::abs(first.y_m - found.y_m), std::abs(last.y_m - found.y_m));
      return dx * dx + dy * dy < wish_.apart_m * wish_.apart_m &&
             heading_difference_rad(first, found) < wish_.apart_rad;
    });
  }

  const LatticeBounds& bounds_;
  const LatticeWish& wish_;
  std::vector<std::vector<Block>>& blocks_;
  std::vector<StartPose>& found_;
  int hopeless_;
  std::atomic<int> best_{1 << 30};  // cost of the best pose so far, which what is found does not hang on
};

}  // namespace

void search_lattice(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                    const PoseLattice& lattice, const LatticeWish& wish, LatticeScratch& scratch,
                    std::vector<StartPose>& found) {
  found.clear();
  if (points.empty()) return;
  assert(points.size() <= TileSums::kMostCells);
  const LatticeBounds bounds(points, map, lattice, scratch.cells);
  Search(bounds, wish, scratch.blocks, found).run();
}

}  // namespace beaconless
