// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/suggest.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

const std::vector<std::string> kKnown{"icp.max_pair_distance_m", "icp.loss", "icp.iterations", "walls"};

TEST(Suggest, NamesTheNearestWord) {
  EXPECT_EQ(nearest_word("icp.los", kKnown), "icp.loss");
  EXPECT_EQ(nearest_word("icp.iteratoins", kKnown), "icp.iterations");
  EXPECT_EQ(nearest_word("wall", kKnown), "walls");
  EXPECT_EQ(nearest_word("icp.max_pair_distance", kKnown), "icp.max_pair_distance_m");
}

TEST(Suggest, AWordThatIsThereIsItsOwnNearest) {
  for (const std::string& word : kKnown) EXPECT_EQ(nearest_word(word, kKnown), word);
}

TEST(Suggest, SaysNothingRatherThanNonsense) {
  EXPECT_EQ(nearest_word("resolution", kKnown), "");
  EXPECT_EQ(nearest_word("x", kKnown), "");
  EXPECT_EQ(nearest_word("walls", {}), "");
}

}  // namespace
}  // namespace beaconless
