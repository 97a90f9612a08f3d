// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/max_clique.hpp"

#include <algorithm>
#include <bit>

namespace beaconless {
namespace {

using Bits = std::span<std::uint64_t>;

/// The lowest member; the size of the set in bits where it has none.
std::size_t first_of(std::span<const std::uint64_t> set) {
  for (std::size_t w = 0; w < set.size(); ++w)
    if (set[w] != 0) return w * 64 + static_cast<std::size_t>(std::countr_zero(set[w]));
  return set.size() * 64;
}

void remove(Bits set, std::size_t i) { set[i / 64] &= ~(std::uint64_t{1} << (i % 64)); }

/// Puts nodes of the smallest remaining degree last, again and again, and renumbers the graph by that order,
/// so that the search branches on sparse nodes first and colours dense ones first.
void order(const BitGraph& graph, MaxCliqueScratch& scratch) {
  const std::size_t size = graph.size();
  scratch.degree.assign(size, 0);
  scratch.node_of.assign(size, 0);
  for (std::size_t a = 0; a < size; ++a)
    for (const std::uint64_t word : graph.neighbours(a))
      scratch.degree[a] += static_cast<std::size_t>(std::popcount(word));
  constexpr auto kTaken = static_cast<std::size_t>(-1);
  for (std::size_t place = size; place-- > 0;) {
    const auto least = std::min_element(scratch.degree.begin(), scratch.degree.end());
    const auto node = static_cast<std::size_t>(least - scratch.degree.begin());
    *least = kTaken;
    scratch.node_of[place] = node;
    for (std::size_t b = 0; b < size; ++b)
      if (scratch.degree[b] != kTaken && graph.connected(node, b)) --scratch.degree[b];
  }
  scratch.ordered.reset(size);
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t b = a + 1; b < size; ++b)
      if (graph.connected(scratch.node_of[a], scratch.node_of[b])) scratch.ordered.connect(a, b);
}

class Search {
 public:
  Search(MaxCliqueScratch& scratch, int node_limit)
      : scratch_(scratch), words_(scratch.ordered.words()), left_(node_limit) {}

  bool run() {
    scratch_.current.clear();
    scratch_.best.clear();
    grow(0);
    const Bits all = candidates_at(0);
    for (std::size_t i = 0; i < scratch_.ordered.size(); ++i) all[i / 64] |= std::uint64_t{1} << (i % 64);
    expand(0);
    return left_ >= 0;
  }

 private:
  static constexpr std::size_t kSets = 3;  // a depth

  Bits set(std::size_t which) { return Bits(scratch_.sets).subspan(which * words_, words_); }
  Bits candidates_at(std::size_t depth) { return set(depth * kSets); }
  Bits uncoloured_at(std::size_t depth) { return set(depth * kSets + 1); }
  Bits one_colour_at(std::size_t depth) { return set(depth * kSets + 2); }

  /// Makes room for the sets of one depth more.
  void grow(std::size_t depth) {
    const std::size_t needed = (depth + 1) * kSets * words_;
    if (scratch_.sets.size() < needed) scratch_.sets.resize(needed);
    if (scratch_.branches.size() <= depth) scratch_.branches.resize(depth + 1);
    const Bits candidates = candidates_at(depth);
    std::fill(candidates.begin(), candidates.end(), 0);
  }

  /// Colours the candidates greedily; those whose colour could lead to a better clique become branches, in
  /// ascending colour. A clique has one node of a colour at most.
  void colour(std::size_t depth) {
    auto& branches = scratch_.branches[depth];
    branches.clear();
    const Bits uncoloured = uncoloured_at(depth);
    const Bits of_colour = one_colour_at(depth);
    std::copy_n(candidates_at(depth).begin(), words_, uncoloured.begin());
    const std::size_t needed =
        scratch_.best.size() >= scratch_.current.size() ? scratch_.best.size() - scratch_.current.size() : 0;
    for (std::size_t colour = 1;; ++colour) {
      std::copy_n(uncoloured.begin(), words_, of_colour.begin());
      std::size_t node = first_of(of_colour);
      if (node == words_ * 64) return;
      for (; node != words_ * 64; node = first_of(of_colour)) {
        remove(uncoloured, node);
        remove(of_colour, node);
        const auto neighbours = scratch_.ordered.neighbours(node);
        for (std::size_t w = 0; w < words_; ++w) of_colour[w] &= ~neighbours[w];
        if (colour > needed) branches.push_back({node, colour});
      }
    }
  }

  void expand(std::size_t depth) {
    if (--left_ < 0) return;
    colour(depth);
    for (std::size_t k = scratch_.branches[depth].size(); k-- > 0 && left_ >= 0;) {
      const auto [node, bound] = scratch_.branches[depth][k];
      if (scratch_.current.size() + bound <= scratch_.best.size()) return;
      scratch_.current.push_back(node);
      if (scratch_.current.size() > scratch_.best.size()) scratch_.best = scratch_.current;
      grow(depth + 1);
      const Bits here = candidates_at(depth);
      const Bits below = candidates_at(depth + 1);
      const auto neighbours = scratch_.ordered.neighbours(node);
      std::uint64_t any = 0;
      for (std::size_t w = 0; w < words_; ++w) any |= below[w] = here[w] & neighbours[w];
      if (any != 0) expand(depth + 1);
      scratch_.current.pop_back();
      remove(candidates_at(depth), node);
    }
  }

  MaxCliqueScratch& scratch_;
  std::size_t words_;
  int left_;
};

}  // namespace

bool find_max_clique(const BitGraph& graph, int node_limit, MaxCliqueScratch& scratch,
                     std::vector<std::size_t>& out) {
  out.clear();
  if (graph.size() == 0) return true;
  order(graph, scratch);
  const bool certain = Search(scratch, node_limit).run();
  out.reserve(scratch.best.size());
  for (const std::size_t place : scratch.best) out.push_back(scratch.node_of[place]);
  std::sort(out.begin(), out.end());
  return certain;
}

}  // namespace beaconless
