// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/max_clique.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

BitGraph random_graph(std::size_t nodes, double density, Rng& rng) {
  BitGraph graph;
  graph.reset(nodes);
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t b = a + 1; b < nodes; ++b)
      if (rng.uniform() < density) graph.connect(a, b);
  return graph;
}

bool is_clique(const BitGraph& graph, const std::vector<std::size_t>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = i + 1; j < nodes.size(); ++j)
      if (!graph.connected(nodes[i], nodes[j])) return false;
  return true;
}

/// Every subset of the nodes.
std::size_t slow_twin(const BitGraph& graph) {
  std::size_t largest = 0;
  for (std::uint32_t subset = 0; subset < (1U << graph.size()); ++subset) {
    if (static_cast<std::size_t>(std::popcount(subset)) <= largest) continue;
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < graph.size(); ++i)
      if (((subset >> i) & 1U) != 0) nodes.push_back(i);
    if (is_clique(graph, nodes)) largest = nodes.size();
  }
  return largest;
}

TEST(MaxClique, IsTheLargestOfAllSubsets) {
  Rng rng(1);
  MaxCliqueScratch scratch;
  std::vector<std::size_t> found;
  for (int run = 0; run < 150; ++run) {
    const auto nodes = static_cast<std::size_t>(rng.uniform(1.0, 14.0));
    const BitGraph graph = random_graph(nodes, rng.uniform(), rng);
    ASSERT_TRUE(find_max_clique(graph, 1'000'000, scratch, found));
    ASSERT_TRUE(is_clique(graph, found));
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    ASSERT_EQ(found.size(), slow_twin(graph)) << run;
  }
}

TEST(MaxClique, FindsThePlantedOneInALargeGraph) {
  Rng rng(2);
  MaxCliqueScratch scratch;
  std::vector<std::size_t> found;
  for (const std::size_t nodes : {63U, 64U, 65U, 128U, 500U}) {
    BitGraph graph = random_graph(nodes, 0.1, rng);
    std::vector<std::size_t> planted;
    for (std::size_t i = 0; i < 15; ++i) planted.push_back(i * (nodes - 1) / 14);
    for (std::size_t i = 0; i < planted.size(); ++i)
      for (std::size_t j = i + 1; j < planted.size(); ++j) graph.connect(planted[i], planted[j]);
    EXPECT_TRUE(find_max_clique(graph, 100'000, scratch, found));
    EXPECT_TRUE(is_clique(graph, found));
    EXPECT_GE(found.size(), 15U);
    if (found.size() == 15) {
      EXPECT_EQ(found, planted);
    }
  }
}

TEST(MaxClique, SaysWhenItsLimitEndedTheSearch) {
  Rng rng(3);
  const BitGraph graph = random_graph(200, 0.8, rng);
  MaxCliqueScratch scratch;
  std::vector<std::size_t> some;
  std::vector<std::size_t> more;
  EXPECT_FALSE(find_max_clique(graph, 10, scratch, some));
  EXPECT_FALSE(find_max_clique(graph, 1000, scratch, more));
  EXPECT_TRUE(is_clique(graph, some));
  EXPECT_GE(some.size(), 5U);
  EXPECT_GE(more.size(), some.size());
}

TEST(MaxClique, OfTheSimplestGraphs) {
  MaxCliqueScratch scratch;
  std::vector<std::size_t> found{7};
  BitGraph graph;
  EXPECT_TRUE(find_max_clique(graph, 10, scratch, found));
  EXPECT_TRUE(found.empty());
  graph.reset(1);
  EXPECT_TRUE(find_max_clique(graph, 10, scratch, found));
  EXPECT_EQ(found, std::vector<std::size_t>{0});
  graph.reset(70);  // no edges: any one node
  EXPECT_TRUE(find_max_clique(graph, 10, scratch, found));
  EXPECT_EQ(found.size(), 1U);
  for (std::size_t a = 0; a < 70; ++a)
    for (std::size_t b = a + 1; b < 70; ++b) graph.connect(a, b);
  EXPECT_TRUE(find_max_clique(graph, 1000, scratch, found));
  EXPECT_EQ(found.size(), 70U);
}

}  // namespace
}  // namespace beaconless
