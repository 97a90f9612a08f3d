// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/stamp.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

TEST(Stamp, ReadsDecimalsWithoutADouble) {
  EXPECT_EQ(parse_stamp("1411657682.042859001")->ns, 1411657682042859001);
  EXPECT_EQ(parse_stamp("-0.5")->ns, -500'000'000);
  EXPECT_EQ(parse_stamp("12")->ns, 12'000'000'000);
  EXPECT_EQ(parse_stamp("1e3")->ns, 1'000'000'000'000);
  EXPECT_EQ(parse_stamp("0.1234567899")->ns, 123'456'789);
}

TEST(Stamp, RefusesWhatIsNoTime) {
  for (const char* text : {"", "-", ".", "nan", "inf", "1.2.3", "12s", "99999999999999999999", "1e300"})
    EXPECT_FALSE(parse_stamp(text)) << text;
}

TEST(Stamp, TextReadsBackAsTheSameNanosecond) {
  for (const std::int64_t ns : {0L, 1L, -1L, 999'999'999L, 1411657682042859001L, -1411657682042859001L})
    EXPECT_EQ(parse_stamp(to_string(Stamp{ns}))->ns, ns);
}

TEST(Stamp, SecondsBetweenIsExactForLargeStamps) {
  EXPECT_DOUBLE_EQ(seconds_between(Stamp{1411657682000000000}, Stamp{1411657682000000025}), 25e-9);
}

}  // namespace
}  // namespace beaconless
