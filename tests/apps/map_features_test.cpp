// SPDX-License-Identifier: Apache-2.0
// `beaconless map features`: what it writes, draws and says, and what it refuses.
#include <sstream>

#include <gmock/gmock.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/match/feature_map.hpp"

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class MapFeatures : public Program {
 protected:
  const std::string plan = std::string(BEACONLESS_SOURCE_DIR) + "/data/plans/room-emptied.yaml";
};

TEST_F(MapFeatures, WritesWhatTheLibraryFinds) {
  const Ran ran = run({"map", "features", plan, "--detector", "corners,falko", "--csv", folder.path("f.csv"),
                       "--plot", folder.path("f.svg"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto said = ran.json();
  std::istringstream csv(folder.read("f.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  EXPECT_THAT(line, StartsWith("detector,x_m,y_m,orientation_rad"));
  const Map map = io::read_map(plan).value();
  std::size_t row = 0;
  for (const Detector detector : {Detector::corners, Detector::falko}) {
    const FeatureMap features = build_feature_map(map, detector).value();
    EXPECT_EQ(said["detectors"][row]["detector"], to_string(detector));
    EXPECT_EQ(said["detectors"][row++]["features"], features.features.size());
    for (std::size_t i = 0; i < features.features.size(); ++i) {
      ASSERT_TRUE(std::getline(csv, line));
      const auto words = split_words(line, ",");
      ASSERT_EQ(words.size(), 10U) << line;
      EXPECT_EQ(words[0], to_string(detector));
      EXPECT_NEAR(parse_double(words[1]).value(), features.features[i].point.x(), 1e-6);
      EXPECT_NEAR(parse_double(words[3]).value(), features.features[i].orientation_rad, 1e-6);
      EXPECT_EQ(words[8], std::to_string(features.evidence[i].found_views));
    }
  }
  EXPECT_FALSE(std::getline(csv, line));
  EXPECT_THAT(folder.read("f.svg"), HasSubstr("room-emptied.yaml: falko"));
}

TEST_F(MapFeatures, TakesParametersByTheirNames) {
  const Ran ran = run({"map", "features", plan, "--set", "features.corners.min_arm_m=0.55", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Ran all = run({"map", "features", plan, "--json"});
  EXPECT_LT(ran.json()["detectors"][0]["features"], all.json()["detectors"][0]["features"]);
}

TEST_F(MapFeatures, RefusesWhatItCannotDo) {
  const auto error_of = [&](const Words& more, int exit_code) {
    const Ran ran = run(Words{"map", "features"} + more);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_EQ(ran.out, "");
    return ran.err;
  };
  EXPECT_THAT(error_of({plan, "--detector", "flako"}, 2), HasSubstr("falko"));
  EXPECT_THAT(error_of({plan, "--set", "feature_map.views.step_m=-1"}, 2), HasSubstr("step_m"));
  EXPECT_THAT(error_of({plan, "--csv", plan}, 2), HasSubstr("read"));
  EXPECT_THAT(error_of({plan, "--csv", folder.path("x"), "--plot", folder.path("x")}, 2), HasSubstr("same"));
  EXPECT_THAT(error_of({folder.path("none.yaml")}, 3), HasSubstr("none.yaml"));
}

}  // namespace
}  // namespace beaconless
