// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/kld.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/particle/pose_bins.hpp"

namespace beaconless {
namespace {

TEST(Kld, CountsAreThoseOfTheFormula) {
  // Computed by another program.
  for (const auto& [bins, count] :
       {std::pair{2U, 66U}, {10U, 217U}, {50U, 750U}, {100U, 1347U}, {500U, 5755U}})
    EXPECT_EQ(kld_sample_count(bins, 0.05, 2.326), count) << bins;
}

TEST(Kld, OneBinTakesOneSample) {
  EXPECT_EQ(kld_sample_count(1, 0.05, 2.326), 1U);
  EXPECT_EQ(kld_sample_count(0, 0.05, 2.326), 1U);
}

TEST(PoseBins, AreHalfAMetreAndTenDegrees) {
  PoseBins bins;
  bins.clear(10);
  EXPECT_EQ(bins.add({0.1, 0.1, 0.01}), 0);
  EXPECT_EQ(bins.add({0.4, 0.4, 0.17}), 0);
  EXPECT_EQ(bins.add({-0.1, 0.1, 0.01}), 1);
  EXPECT_EQ(bins.add({0.1, 0.6, 0.01}), 2);
  EXPECT_EQ(bins.add({0.1, 0.1, 0.18}), 3);
  EXPECT_EQ(bins.add({0.1, 0.1, 0.01 + 2.0 * kPi}), 0);
  EXPECT_EQ(bins.count(), 4U);
  EXPECT_EQ(bins.find(PoseBins::key_of({9, 9, 0})), PoseBins::kNone);
}

TEST(PoseBins, CountAsManyAsThereAreKeys) {
  Rng rng(4);
  PoseBins bins;
  bins.clear(3000);
  std::vector<PoseBins::Key> keys;
  for (int i = 0; i < 3000; ++i) {
    const Pose2 pose{rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-9, 9)};
    const PoseBins::Key key = PoseBins::key_of(pose);
    const auto known = std::find(keys.begin(), keys.end(), key);
    EXPECT_EQ(bins.add(pose), known - keys.begin());
    if (known == keys.end()) keys.push_back(key);
  }
  EXPECT_EQ(bins.count(), keys.size());
}

}  // namespace
}  // namespace beaconless
