// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/parse.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ParseDouble, ReadsWholeNumbersOnly) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("-3e-4"), -3e-4);
  EXPECT_EQ(parse_double("+2"), 2.0);
  EXPECT_EQ(parse_double(".5"), 0.5);
  EXPECT_TRUE(std::isnan(*parse_double("nan")));
  EXPECT_TRUE(std::isinf(*parse_double("-inf")));
  for (const char* text : {"", " ", "+", "1.5 ", " 1.5", "1,5", "1.5m", "0x10", "1e", "--1", "1e999"})
    EXPECT_FALSE(parse_double(text)) << '"' << text << '"';
}

TEST(ParseDouble, TakesASignOnce) { EXPECT_FALSE(parse_double("+-1")) << "a sign after a sign"; }

TEST(ParseDouble, ReadsBackEveryShortestText) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::bit_cast<double>(rng.bits());
    if (!std::isfinite(value)) continue;
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    EXPECT_EQ(parse_double({text.data(), end}), value);
  }
}

TEST(ParseInt, RefusesWhatDoesNotFit) {
  EXPECT_EQ(parse_int("-12"), -12);
  EXPECT_EQ(parse_int("+12"), 12);
  EXPECT_EQ(parse_int<std::uint8_t>("255"), 255);
  EXPECT_FALSE(parse_int<std::uint8_t>("256"));
  EXPECT_FALSE(parse_int<std::uint8_t>("-1"));
  for (const char* text : {"", "1.0", "1e3", "12 ", "2147483648"}) EXPECT_FALSE(parse_int(text)) << text;
}

TEST(SplitWords, LeavesOutEmptyPieces) {
  EXPECT_THAT(split_words("  a\tbb \r\n c"), ElementsAre("a", "bb", "c"));
  EXPECT_THAT(split_words("1,,2,", ","), ElementsAre("1", "2"));
  EXPECT_THAT(split_words(" \t\n"), IsEmpty());
  EXPECT_THAT(split_words(""), IsEmpty());
}

}  // namespace
}  // namespace beaconless
