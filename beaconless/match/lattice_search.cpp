// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/lattice_search.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <tuple>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/match/share_work.hpp"
#include "beaconless/match/tile_sums.hpp"

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

/// One search: the lattice, and what is known of it so far.
class Search {
 public:
  Search(std::size_t points, const Pyramid& map, const PoseLattice& lattice, const LatticeWish& wish,
         LatticeScratch& scratch, std::vector<StartPose>& found)
      : points_(points),
        map_(map),
        lattice_(lattice),
        wish_(wish),
        scratch_(scratch),
        found_(found),
        columns_(2 * lattice.moves_x + 1),
        rows_(2 * lattice.moves_y + 1),
        worst_(Pyramid::kOnSurface * static_cast<int>(points)),
        hopeless_(static_cast<int>(wish.hopeless * worst_)),
        per_move2_(penalty_per_step2(std::max(lattice.moves_x, lattice.moves_y))),
        per_turn2_(penalty_per_step2(lattice.turns)) {}

  void run(std::span<const Eigen::Vector2d> points) {
    turn(points);
    // 1. Bounds for all of the lattice.
    bound_all();
    auto& blocks = scratch_.blocks.front();
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
        found_.push_back({pose_of(block), static_cast<double>(block.cost) / worst_});
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
  float penalty_per_step2(int steps) const {
    const int most = std::max(1, steps);
    return static_cast<float>(lattice_.far_penalty * worst_) / static_cast<float>(most * most);
  }

  int limit() const { return best_.load(std::memory_order_relaxed) + hopeless_; }

  void lower_best(int cost) {
    int best = best_.load(std::memory_order_relaxed);
    while (cost < best && !best_.compare_exchange_weak(best, cost, std::memory_order_relaxed)) {
    }
  }

  /// The cells of the points at every heading, as seen from the lattice's first pose.
  void turn(std::span<const Eigen::Vector2d> points) {
    constexpr std::size_t kApart = 8;
    constexpr double kFar = 1e8;  // cells; nothing is there, but numbers stay those of an int
    const Eigen::Vector2d first = (lattice_.middle.translation() - map_.low()) / map_.cell_m() -
                                  Eigen::Vector2d(lattice_.moves_x, lattice_.moves_y);
    scratch_.cells.clear();
    for (int heading = 0; heading <= 2 * lattice_.turns; ++heading) {
      const Eigen::Matrix2d rotation = Pose2{0.0, 0.0, theta_of(heading)}.rotation() / map_.cell_m();
      // Neighbours apart, so that any few of them are of the whole scan and tell soon that it does not fit.
      for (std::size_t begin = 0; begin < kApart; ++begin)
        for (std::size_t i = begin; i < points.size(); i += kApart)
          scratch_.cells.push_back(cell_of((first + rotation * points[i]).cwiseMax(-kFar).cwiseMin(kFar)));
    }
  }

  std::span<const Cell> cells(int heading) const {
    return std::span<const Cell>(scratch_.cells)
        .subspan(static_cast<std::size_t>(heading) * points_, points_);
  }

  double theta_of(int heading) const {
    return wrap_angle(lattice_.middle.theta_rad + (heading - lattice_.turns) * lattice_.step_rad);
  }

  Pose2 pose_of(const Block& block) const {
    return {lattice_.middle.x_m + (block.x - lattice_.moves_x) * map_.cell_m(),
            lattice_.middle.y_m + (block.y - lattice_.moves_y) * map_.cell_m(), theta_of(block.heading)};
  }

  int turn_penalty(int heading) const {
    const int turned = heading - lattice_.turns;
    return static_cast<int>(per_turn2_ * static_cast<float>(turned * turned));
  }

  /// The least of any of its poses.
  int move_penalty(int level, int x, int y) const {
    const int last = Pyramid::block_cells(level) - 1;
    const int dx = std::max({0, x - lattice_.moves_x, lattice_.moves_x - x - last});
    const int dy = std::max({0, y - lattice_.moves_y, lattice_.moves_y - y - last});
    return static_cast<int>(per_move2_ * static_cast<float>(dx * dx + dy * dy));
  }

  /// Calls visit(block) for every block of a tile that begins in the lattice.
  template <class Visit>
  void for_tile(int level, int heading, int x, int y, int columns, int rows, const Visit& visit) const {
    const int step = Pyramid::block_cells(level);
    const int turned = turn_penalty(heading);
    const TileSums sums = sum_tiles(map_, level, cells(heading), x, y, worst_ + turned - limit());
    for (int row = 0; row < rows && y + row * step < rows_; ++row)
      for (int column = 0; column < columns && x + column * step < columns_; ++column) {
        const int bx = x + column * step;
        const int by = y + row * step;
        const int misfit = worst_ - sums.at(column, row);
        if (misfit + turned > limit()) continue;
        const int cost = misfit + std::max(turned, move_penalty(level, bx, by));
        if (cost <= limit()) visit(Block{cost, level, heading, bx, by});
      }
  }

  template <class Visit>
  void split(const Block& block, const Visit& visit) const {
    for_tile(block.level - 1, block.heading, block.x, block.y, kFan, kFan, visit);
  }

  /// Fills the first list of blocks with all that may hold what is wanted, or their parts.
  ///
  /// Whatever order headings are taken in, and whoever takes them: the limit that they are held against is
  /// never below that of the best pose there is.
  void bound_all() {
    scratch_.blocks.resize(static_cast<std::size_t>(std::max(1, wish_.threads)));
    for (auto& blocks : scratch_.blocks) blocks.clear();
    const int headings = 2 * lattice_.turns + 1;
    const auto size = static_cast<double>(Pyramid::block_cells(kTop));
    const bool is_wide = (columns_ / size + 1.0) * (rows_ / size + 1.0) * headings > kWide;
    // 1. A few blocks as they are, from the middle heading outwards: what is near is likely to be good.
    if (!is_wide) {
      for (int k = 0; k < headings; ++k)
        cover(outwards(k), [&](const Block& block) { scratch_.blocks.front().push_back(block); });
      return;
    }
    // 2. Of many first a limit, then the parts that it leaves.
    share_work(headings, wish_.threads, [&](int k, std::size_t) { cover(outwards(k), [](const Block&) {}); });
    share_work(headings, wish_.threads,
               [&](int k, std::size_t worker) { cover_by_parts(outwards(k), scratch_.blocks[worker]); });
    for (std::size_t i = 1; i < scratch_.blocks.size(); ++i)
      scratch_.blocks[0].insert(scratch_.blocks[0].end(), scratch_.blocks[i].begin(),
                                scratch_.blocks[i].end());
  }

  int outwards(int k) const { return lattice_.turns + (k % 2 == 0 ? k / 2 : -(k + 1) / 2); }

  /// Visits all blocks of a heading. The best of them is followed down to a pose, as whose cost sets a limit.
  template <class Visit>
  void cover(int heading, const Visit& visit) {
    const int step = Pyramid::block_cells(kTop);
    Block best = none();
    for (int y = 0; y < rows_; y += Pyramid::kTileRows * step)
      for (int x = 0; x < columns_; x += Pyramid::kTileColumns * step)
        for_tile(kTop, heading, x, y, Pyramid::kTileColumns, Pyramid::kTileRows, [&](const Block& block) {
          visit(block);
          if (block.cost < best.cost) best = block;
        });
    follow(best);
  }

  /// The parts of all blocks of a heading: of several blocks side by side at once, which is a tile of parts.
  void cover_by_parts(int heading, std::vector<Block>& parts) {
    const int step = Pyramid::block_cells(kTop);
    Block best = none();
    for (int y = 0; y < rows_; y += Pyramid::kTileRows * step)
      for (int x = 0; x < columns_; x += Pyramid::kTileColumns * step) {
        int last = -1;  // of the tiles of parts that were taken
        for_tile(kTop, heading, x, y, Pyramid::kTileColumns, Pyramid::kTileRows, [&](const Block& block) {
          const int first_x = block.x - (block.x - x) % (kSide * step);
          const int tile = (block.y - y) / step * Pyramid::kTileColumns + (first_x - x) / step;
          if (tile == last) return;
          last = tile;
          for_tile(kTop - 1, heading, first_x, block.y, Pyramid::kTileColumns, kFan, [&](const Block& part) {
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
    const Pose2 first = pose_of(block);
    const Pose2 last = pose_of({0, 0, block.heading, block.x + size - 1, block.y + size - 1});
    return std::any_of(found_.begin(), found_.end(), [&](const StartPose& start) {
      const Pose2& found = start.map_from_laser;
      const double dx = std::max(std::abs(first.x_m - found.x_m), std::abs(last.x_m - found.x_m));
      const double dy = std::max(std::abs(first.y_m - found.y_m), std::abs(last.y_m - found.y_m));
      return dx * dx + dy * dy < wish_.apart_m * wish_.apart_m &&
             heading_difference_rad(first, found) < wish_.apart_rad;
    });
  }

  std::size_t points_;
  const Pyramid& map_;
  const PoseLattice& lattice_;
  const LatticeWish& wish_;
  LatticeScratch& scratch_;
  std::vector<StartPose>& found_;
  int columns_;
  int rows_;
  int worst_;  // cost of the worst fit; costs are whole numbers here
  int hopeless_;
  std::atomic<int> best_{1 << 30};  // cost of the best pose so far, which what is found does not hang on
  float per_move2_;
  float per_turn2_;
};

}  // namespace

void search_lattice(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                    const PoseLattice& lattice, const LatticeWish& wish, LatticeScratch& scratch,
                    std::vector<StartPose>& found) {
  found.clear();
  if (points.empty()) return;
  assert(points.size() <= TileSums::kMostCells);
  Search(points.size(), map, lattice, wish, scratch, found).run(points);
}

}  // namespace beaconless
