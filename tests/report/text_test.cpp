// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/text.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace beaconless::report {
namespace {

TEST(Escaped, TakesTheMeaningFromMarkup) {
  EXPECT_EQ(escaped("<script>alert('x' & \"y\")</script>"),
            "&lt;script&gt;alert(&#39;x&#39; &amp; &quot;y&quot;)&lt;/script&gt;");
}

TEST(Escaped, KeepsOtherAlphabetsAndReplacesWhatIsNoUtf8) {
  EXPECT_EQ(escaped("Cramér–Rao µs 走 😀"), "Cramér–Rao µs 走 😀");
  EXPECT_EQ(escaped("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(escaped("\xC3"), "\uFFFD");                      // cut off in the middle
  EXPECT_EQ(escaped("\xC0\xBC"), "\uFFFD\uFFFD");            // an overlong '<'
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // half a surrogate pair
  EXPECT_EQ(escaped(std::string("a\0\x01\x1B"
                                "b\n",
                                6)),
            "ab\n");  // XML has no control characters
}

TEST(Number, IsShortAndAlwaysANumber) {
  EXPECT_EQ(number(1.5), "1.5");
  EXPECT_EQ(number(-0.001), "0");
  EXPECT_EQ(number(100.0), "100");
  EXPECT_EQ(number(2.0 / 3.0, 3), "0.667");
  EXPECT_EQ(number(std::nan("")), "0");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "0");
  EXPECT_EQ(number(1e300), "10000000");
}

TEST(Significant, ShowsAsManyDigitsAsAsked) {
  EXPECT_EQ(significant(0.000717, 3), "0.000717");
  EXPECT_EQ(significant(1.1, 3), "1.10");
  EXPECT_EQ(significant(1234.5, 3), "1234");
  EXPECT_EQ(significant(0.0), "0");
  EXPECT_EQ(significant(std::nan("")), "–");
  EXPECT_EQ(significant(1e-12, 2), "1.0e-12");
}

TEST(Grouped, SetsThousandsApart) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(4000), "4000");
  EXPECT_EQ(grouped(1234567), "1\u202F234\u202F567");
}

}  // namespace
}  // namespace beaconless::report
