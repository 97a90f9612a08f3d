// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/scan_selection.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

using Chosen = std::vector<std::uint64_t>;

Chosen chosen(const std::string& text, std::uint64_t count = 10) {
  const auto selection = io::ScanSelection::parse(text).value();
  Chosen scans;
  for (std::uint64_t i = 0; i < count; ++i)
    if (selection.wants(i)) scans.push_back(i);
  return scans;
}

TEST(ScanSelection, IsPythonsSlice) {
  EXPECT_EQ(chosen(""), (Chosen{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(chosen(":"), chosen(""));
  EXPECT_EQ(chosen("::"), chosen(""));
  EXPECT_EQ(chosen("1::2"), (Chosen{1, 3, 5, 7, 9}));
  EXPECT_EQ(chosen("0:3"), (Chosen{0, 1, 2}));
  EXPECT_EQ(chosen(":7:3"), (Chosen{0, 3, 6}));
  EXPECT_EQ(chosen("5"), (Chosen{5}));
  EXPECT_EQ(chosen("8:"), (Chosen{8, 9}));
  EXPECT_EQ(chosen("5:5"), (Chosen{}));
  EXPECT_EQ(chosen("7:3"), (Chosen{}));
}

TEST(ScanSelection, KnowsWhenItIsDone) {
  for (const std::string text : {"", "5", "1::2", "0:3", ":7:3", "2:9:4", "5:5", "7:3", "3:100:50"}) {
    const auto selection = io::ScanSelection::parse(text).value();
    for (std::uint64_t i = 0; i < 200; ++i) {
      bool any_later = false;
      for (std::uint64_t later = i + 1; later < 1000; ++later)
        any_later = any_later || selection.wants(later);
      EXPECT_EQ(selection.done_after(i), !any_later) << text << " after " << i;
    }
  }
}

TEST(ScanSelection, RefusesWhatItCannotMean) {
  for (const std::string text : {"-1", "-5:", ":-1", "::-1", "::0", "a", "1:b", "1:2:3:4", " ", "1.5", "::1x",
                                 "99999999999999999999", "18446744073709551615"})
    EXPECT_FALSE(io::ScanSelection::parse(text)) << text;
}

}  // namespace
}  // namespace beaconless
