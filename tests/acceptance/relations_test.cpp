// SPDX-License-Identifier: Apache-2.0
// The official relations of Freiburg 079, and what the log's own poses score on them.
#include <gmock/gmock.h>

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

class Fr079 : public Program {
 protected:
  void SetUp() override {
    if (recorded("fr079/fr079.relations").empty())
      GTEST_SKIP() << "fr079 is not here; BEACONLESS_DATA names its folder";
    const Ran ran = run({"poses", log(), "--topic", "FLASER", "--out", poses()});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
  }
  static std::string log() { return recorded("fr079/freiburg-079-corrected.log.gz"); }
  std::string poses() const { return folder.path("gmapping.tum"); }
};

// Oracle: an independent evaluation of the same poses, 0.0590 ± 0.0422 m and 0.713 ± 0.695 deg. Published for
// GMapping (Kümmerle et al. 2009): 0.061 ± 0.044 m.
TEST_F(Fr079, GMappingPosesScoreWhatIsKnownOfThem) {
  for (const Words& more : {Words{}, Words{"--recording", log()}}) {
    const Ran ran =
        run(Words{"evaluate", poses(), "--relations", recorded("fr079/fr079.relations.scanindex"), "--json"} +
            more);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto told = ran.json();
    EXPECT_EQ(told["relations"], 1638);
    EXPECT_EQ(told["without_pose"], 0);
    EXPECT_NEAR(told["translation_m"]["mean"].get<double>(), 0.0590, 5e-5);
    EXPECT_NEAR(told["translation_m"]["sd"].get<double>(), 0.0422, 5e-5);
    EXPECT_NEAR(told["rotation_deg"]["mean"].get<double>(), 0.713, 5e-4);
    EXPECT_NEAR(told["rotation_deg"]["sd"].get<double>(), 0.695, 5e-4);
  }
}

// The log's clock is not that of the relations: it runs 1211.45 s behind and its stamps scatter by 0.1 s,
// less than half a scan. 47 relations are of scans that this log lacks.
TEST_F(Fr079, OfficialStampsAreOfAnotherClock) {
  const Words words{"evaluate", poses(), "--relations", recorded("fr079/fr079.relations"), "--json"};
  const Ran apart = run(words);
  EXPECT_EQ(apart.exit_code, 3);
  EXPECT_THAT(apart.err, testing::HasSubstr("--clock-offset"));
  const Ran ran = run(words + Words{"--clock-offset", "1211.45"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["relations"], 1685);
  EXPECT_GT(ran.json()["without_pose"], 0);
  EXPECT_LT(ran.json()["without_pose"], 60);
  EXPECT_NEAR(ran.json()["translation_m"]["mean"].get<double>(), 0.0590, 0.002);
}

}  // namespace
}  // namespace beaconless
