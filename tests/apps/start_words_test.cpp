// SPDX-License-Identifier: Apache-2.0
// What `--start` and `--windows` may say.
#include "apps/beaconless/start_words.hpp"

#include <gmock/gmock.h>

#include "apps/beaconless/window_words.hpp"

namespace beaconless::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(StartWords, SayAPoseAnywhereARegionOrAFile) {
  const auto here = std::get<StartHere>(start_from_words("1.5,-2,90").value());
  EXPECT_EQ(here.map_from_base.x_m, 1.5);
  EXPECT_EQ(here.map_from_base.y_m, -2.0);
  EXPECT_NEAR(here.map_from_base.theta_rad, radians(90.0), 1e-12);
  EXPECT_FALSE(std::get<StartAnywhere>(start_from_words("auto").value()).within);
  const auto within = std::get<StartAnywhere>(start_from_words("near:-3,4.5,2").value()).within;
  ASSERT_TRUE(within);
  EXPECT_EQ(within->middle, Eigen::Vector2d(-3.0, 4.5));
  EXPECT_EQ(within->radius_m, 2.0);
  EXPECT_EQ(std::get<StartResumed>(start_from_words("resume:a:b.yaml").value()).pose_file, "a:b.yaml");
}

TEST(StartWords, WhatIsNoneIsToldWithTheFormThatWasMeant) {
  const std::vector<std::pair<std::string, std::string>> wrongs{{"here", "x,y,deg"},
                                                                {"", "auto"},
                                                                {"1,2", "x,y,deg"},
                                                                {"nan,0,0", "x,y,deg"},
                                                                {"Auto", "auto"},
                                                                {"auto:", "auto"},
                                                                {"near", "near:x,y,radius"},
                                                                {"near:1,2", "near:x,y,radius"},
                                                                {"near:1,2,0", "radius"},
                                                                {"near:1,2,-1", "radius"},
                                                                {"near:1,2,inf", "radius"},
                                                                {"near:nan,2,1", "near:x,y,radius"},
                                                                {"near:1,2,3,4", "radius"},
                                                                {"resume", "resume:FILE"},
                                                                {"resume:", "--save-pose"}};
  for (const auto& [wrong, meant] : wrongs) {
    const auto start = start_from_words(wrong);
    ASSERT_FALSE(start) << wrong;
    EXPECT_EQ(start.error().where, "--start");
    EXPECT_THAT(start.error().what, HasSubstr("\"" + wrong + "\""));
    EXPECT_THAT(start.error().remedy, HasSubstr(meant)) << wrong;
  }
}

TEST(StartWords, AWordWithALetterWrongIsToldWithTheOneThatWasMeant) {
  for (const auto& [wrong, meant] : {std::pair{"AUTO", "auto"},
                                     {"atuo", "auto"},
                                     {"Auto", "auto"},
                                     {"auto:", "auto"},
                                     {"Near:1,2,3", "near:1,2,3"},
                                     {"naer:1,2,3", "near:1,2,3"},
                                     {"RESUME:Pose.yaml", "resume:Pose.yaml"},
                                     {"resmue:pose.yaml", "resume:pose.yaml"}}) {
    const auto start = start_from_words(wrong);
    ASSERT_FALSE(start) << wrong;
    EXPECT_THAT(start.error().remedy, HasSubstr("did you mean \"" + std::string(meant) + "\"?"));
  }
  for (const char* wrong : {"", "here", "1,2", "nan,0,0", "1.2;3.4;90"})
    EXPECT_THAT(start_from_words(wrong).error().remedy, Not(HasSubstr("did you mean"))) << wrong;
}

TEST(WindowWords, SayLengthAndStride) {
  const Windows windows = windows_from_words("5:20").value();
  EXPECT_EQ(windows.length, 5U);
  EXPECT_EQ(windows.stride, 20U);
  for (const char* wrong :
       {"", "5", "5:", ":5", "0:5", "5:0", "-1:5", "5:20:2", "a:b", "1.5:2", "999999999:1"})
    EXPECT_FALSE(windows_from_words(wrong)) << wrong;
}

}  // namespace
}  // namespace beaconless::cli
