// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/result.hpp"

#include <memory>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

Result<std::vector<int>> three() { return std::vector<int>{1, 2, 3}; }

const Error kError{"map.yaml:3", "resolution is \"-1\"", "allowed: 0.0001 … 100"};

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = 5;
  EXPECT_TRUE(good.ok());
  EXPECT_TRUE(good);
  EXPECT_EQ(*good, 5);
  const Result<int> bad = kError;
  EXPECT_FALSE(bad);
  EXPECT_EQ(bad.error(), kError);
}

TEST(Result, ValueOfAnErrorThrowsItsWords) {
  const Result<int> bad = kError;
  try {
    (void)bad.value();
    FAIL() << "no value was there";
  } catch (const BadResult& thrown) {
    EXPECT_EQ(std::string(thrown.what()), to_string(kError));
  }
}

TEST(Result, AValueOfATemporaryOutlivesIt) {
  int sum = 0;
  for (const int i : three().value()) sum += i;
  EXPECT_EQ(sum, 6);
}

TEST(Result, GivesAwayWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 7);
}

TEST(Error, IsOneLine) {
  EXPECT_EQ(to_string(kError), "map.yaml:3: resolution is \"-1\" (allowed: 0.0001 … 100)");
  EXPECT_EQ(to_string(Error{"", "what", ""}), "what");
  std::ostringstream out;
  out << kError;
  EXPECT_EQ(out.str(), to_string(kError));
}

}  // namespace
}  // namespace beaconless
