// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beaconless::ros1 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Settings, KnowEveryParameterOfTheLocalizer) {
  LocalizerConfig defaults;
  std::map<std::string, std::string> all;
  for (const Field& field : fields_of(defaults)) all[field.name] = field.text();
  const auto settings = settings_of(all);
  ASSERT_TRUE(settings) << settings.error();
  EXPECT_THAT(settings->remarks, IsEmpty());
}

TEST(Settings, TakeNamesOfAmcl) {
  const auto settings = settings_of({{"method", "amcl"},
                                     {"min_particles", "123"},
                                     {"odom_model_type", "omni-corrected"},
                                     {"laser_max_range", "12.5"},
                                     {"odom_frame_id", "/odom_combined"},
                                     {"initial_pose_a", "1"}});
  ASSERT_TRUE(settings) << settings.error();
  EXPECT_THAT(settings->remarks, IsEmpty());
  EXPECT_EQ(settings->localizer.amcl.min_particles, 123);
  EXPECT_EQ(settings->localizer.amcl.odom_model_type, OdometryModel::omni_corrected);
  EXPECT_EQ(gate_of(settings->node).range_max_m, 12.5F);
  EXPECT_EQ(gate_of(settings->node).range_min_m, 0.0F);
  EXPECT_EQ(settings->node.odom_frame_id, "odom_combined");
  EXPECT_TRUE(settings->has_initial_pose);
}

TEST(Settings, SayThatParticlesChangeNothingWithoutThem) {
  const auto settings = settings_of({{"min_particles", "500"}, {"kld_err", "0.05"}});
  ASSERT_TRUE(settings);
  EXPECT_THAT(settings->remarks, ElementsAre(HasSubstr("~method:=amcl")));
}

TEST(Settings, SayWhatAmclHasAndTheNodeHasNot) {
  const auto settings = settings_of({{"gui_publish_rate", "10"}});
  ASSERT_TRUE(settings);
  EXPECT_THAT(settings->remarks, ElementsAre(HasSubstr("~gui_publish_rate changes nothing here: ")));
}

TEST(Settings, SuggestANameForOneThatNobodyKnows) {
  const auto settings = settings_of({{"base_frame", "base"}, {"min_particle", "9"}, {"walls.sigma", "1"}});
  ASSERT_TRUE(settings);
  EXPECT_THAT(settings->remarks, ElementsAre(HasSubstr("did you mean ~base_frame_id?"),
                                             HasSubstr("did you mean ~min_particles?"),
                                             HasSubstr("did you mean ~walls.sigma_m?")));
}

TEST(Settings, RefuseAValueByTheNameThatWasGiven) {
  const auto settings = settings_of({{"min_particles", "many"}});
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().where, "~min_particles");
}

}  // namespace
}  // namespace beaconless::ros1
