// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/tf_rivals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beaconless::ros1 {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;

class TfRivalsTest : public testing::Test {
 protected:
  void hear(const char* parent, const char* child, const char* teller = "/other", bool is_static = false) {
    rivals.hear({0, parent, child, {}}, teller, is_static, 0.0);
  }

  TfRivals rivals{"map", "odom", "base_link"};
};

TEST_F(TfRivalsTest, HaveNothingAgainstAWholeRobot) {
  hear("odom", "base_link", "/wheels"), hear("odom", "base_link", "/player");
  hear("base_link", "laser", "/urdf", true), hear("earth", "map", "/site", true), hear("laser", "camera");
  EXPECT_EQ(rivals.loop("odom", 0.0), std::nullopt);
  EXPECT_EQ(rivals.beside("odom", 0.0), std::nullopt);
}

TEST_F(TfRivalsTest, SeeALoopThroughOtherFrames) {
  hear("world", "map", "/site", true), hear("/odom", "/world", "/player");
  EXPECT_THAT(rivals.loop("odom", 0.0), Optional(HasSubstr("/site tells \"map\" below \"world\"")));
  EXPECT_EQ(rivals.loop("base_link", 0.0), std::nullopt);
  EXPECT_EQ(rivals.loop("odom", 11.0), std::nullopt);
}

TEST_F(TfRivalsTest, SeeALoopBelowTheBase) {
  hear("base_link", "map");
  EXPECT_THAT(rivals.loop("base_link", 0.0), Optional(HasSubstr("loop")));
}

TEST_F(TfRivalsTest, RememberAStaticLoopWhateverElseIsTold) {
  hear("odom", "map", "/fixed", true), hear("world", "map");
  EXPECT_THAT(rivals.loop("odom", 1e6), Optional(AllOf(HasSubstr("/fixed"), HasSubstr("static"))));
  rivals.forget();
  EXPECT_EQ(rivals.loop("odom", 1e6), std::nullopt);
}

TEST_F(TfRivalsTest, EndInRingsOfOthers) {
  hear("b", "map"), hear("c", "b"), hear("b", "c");
  EXPECT_EQ(rivals.loop("odom", 0.0), std::nullopt);
}

TEST_F(TfRivalsTest, AMapThatHangsBelowWheelsThatNobodyTellsIsNoLoop) {
  hear("odom", "map");
  EXPECT_EQ(rivals.loop("base_link", 0.0), std::nullopt);
}

TEST_F(TfRivalsTest, NameTwoParentsOfTheBase) {
  hear("odom", "base_link", "/wheels"), hear("map", "base_link", "/rival");
  EXPECT_THAT(rivals.beside("odom", 0.0),
              Optional(AllOf(HasSubstr("/wheels tells \"base_link\" below \"odom\""),
                             HasSubstr("/rival below \"map\""))));
}

TEST_F(TfRivalsTest, NameTheFrameThatMayBeMeant) {
  hear("odom_combined", "base_link", "/ekf");
  EXPECT_THAT(rivals.beside("base_link", 0.0), Optional(HasSubstr("set odom_frame_id to \"odom_combined\"")));
  rivals.forget();
  hear("base_footprint", "base_link", "/urdf", true);
  EXPECT_THAT(rivals.beside("base_link", 0.0),
              Optional(HasSubstr("set base_frame_id to \"base_footprint\"")));
  rivals.forget();
  hear("map", "base_link", "/amcl");
  EXPECT_THAT(rivals.beside("base_link", 0.0), Optional(HasSubstr("end one of the two")));
}

TEST_F(TfRivalsTest, PassOverWhatTfDoesNotTake) {
  TfRivals no_wheels{"map", "", "base_link"};
  for (const auto& [parent, child] :
       {std::pair{"", "map"}, {"map", ""}, {"map", "map"}, {"", "base_link"}, {"/", "map"}})
    no_wheels.hear({0, parent, child, {}}, "/odd", true, 0.0);
  EXPECT_EQ(no_wheels.loop("base_link", 0.0), std::nullopt);
  EXPECT_EQ(no_wheels.beside("base_link", 0.0), std::nullopt);
}

}  // namespace
}  // namespace beaconless::ros1
