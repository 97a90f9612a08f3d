// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace beaconless {

/// An undirected graph as a matrix of bits.
class BitGraph {
 public:
  /// `nodes` nodes, no edges. Allocates only to grow.
  void reset(std::size_t nodes) {
    size_ = nodes;
    words_ = (nodes + 63) / 64;
    bits_.assign(nodes * words_, 0);
  }
  void connect(std::size_t a, std::size_t b) {
    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
    bits_[b * words_ + a / 64] |= std::uint64_t{1} << (a % 64);
  }
  bool connected(std::size_t a, std::size_t b) const {
    return ((bits_[a * words_ + b / 64] >> (b % 64)) & 1U) != 0;
  }
  std::span<const std::uint64_t> neighbours(std::size_t a) const {
    return std::span(bits_).subspan(a * words_, words_);
  }
  std::size_t size() const { return size_; }
  std::size_t words() const { return words_; }

 private:
  std::size_t size_ = 0;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

/// Buffers of find_max_clique().
struct MaxCliqueScratch {
  struct Branch {
    std::size_t node;
    std::size_t colour;
  };
  BitGraph ordered;
  std::vector<std::size_t> node_of;  // the graph's node at each place of the order
  std::vector<std::size_t> degree;
  std::vector<std::uint64_t> sets;  // three a depth: candidates, uncoloured, of one colour
  std::vector<std::vector<Branch>> branches;
  std::vector<std::size_t> current;
  std::vector<std::size_t> best;
};

/// Finds a largest set of nodes that are all connected to each other; ascending in `out`.
///
/// Returns whether it is known to be a largest: false when `node_limit` branches were not enough, and then
/// `out` holds the largest met. Of several the same one comes out each time. Cost: exponential at worst,
/// milliseconds for association graphs of a thousand nodes. Source: branch and bound with greedy colouring on
/// bit sets: Tomita and Seki 2003; San Segundo et al. 2011 (BBMC), with nodes in degeneracy order.
bool find_max_clique(const BitGraph& graph, int node_limit, MaxCliqueScratch& scratch,
                     std::vector<std::size_t>& out);

}  // namespace beaconless
