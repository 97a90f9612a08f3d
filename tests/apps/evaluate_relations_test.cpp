// SPDX-License-Identifier: Apache-2.0
// What `beaconless evaluate --relations` promises.
#include <gmock/gmock.h>

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

/// A robot that drives a metre east, turns left and drives a metre north.
class EvaluateRelations : public Program {
 protected:
  std::string poses() const {
    return folder.write("poses.tum",
                        "10 0 0 0 0 0 0 1\n11 1 0 0 0 0 0.70710678118654752 0.70710678118654752\n"
                        "12 1 1 0 0 0 0.70710678118654752 0.70710678118654752\n");
  }
  Ran evaluate(const std::string& relations, const Words& more = {}) const {
    return run(Words{"evaluate", poses(), "--relations", folder.write("a.relations", relations)} + more);
  }
};

TEST_F(EvaluateRelations, ByStamps) {
  const Ran ran =
      evaluate("10 11 1 0 0 0 0 1.5707963\n11 12 1.1 0 0 0 0 0.02\n10 99 1 0 0 0 0 0\n", {"--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto told = ran.json();
  EXPECT_EQ(told["relations"], 3);
  EXPECT_EQ(told["without_pose"], 1);
  EXPECT_NEAR(told["translation_m"]["mean"].get<double>(), 0.05, 1e-6);
  EXPECT_NEAR(told["translation_m"]["max"].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(told["rotation_deg"]["max"].get<double>(), 1.1459, 1e-3);
  EXPECT_EQ(told.size(), 4U);
}

TEST_F(EvaluateRelations, ByScans) {
  const Ran ran = evaluate("0 1 1 0 1.5707963\n0 2 1 1 1.5707963\n", {"--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["relations"], 2);
  EXPECT_LT(ran.json()["translation_m"]["max"].get<double>(), 1e-6);
}

TEST_F(EvaluateRelations, ScansOfARecordingFindTheirPosesByStamp) {
  std::string log;
  for (const char* stamp : {"10", "10.5", "11", "11.5", "12"})
    log += std::string("FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 ") + stamp + " host " + stamp + "\n";
  const Words recording{"--recording", folder.write("drive.log", log), "--json"};
  const Ran ran = evaluate("0 2 1 0 1.5707963\n2 4 1 0 0\n0 1 1 0 0\n", recording);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["without_pose"], 1) << "scan 1 has no pose";
  EXPECT_LT(ran.json()["translation_m"]["max"].get<double>(), 1e-6);
}

TEST_F(EvaluateRelations, ScansBeyondThePosesAreAnErrorAndNoOtherScans) {
  const Ran ran = evaluate("0 1 1 0 1.5707963\n0 3 1 1 1.5707963\n");
  EXPECT_NE(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr("it counts scans up to 3"));
  EXPECT_THAT(ran.err, HasSubstr("--recording"));
}

TEST_F(EvaluateRelations, PeopleReadMeanAndSpread) {
  const Ran ran = evaluate("10 11 1 0 0 0 0 1.5707963\n11 12 1.1 0 0 0 0 0\n");
  EXPECT_THAT(ran.out, HasSubstr("translation 0.0500 ± 0.0500 m"));
  EXPECT_THAT(ran.out, HasSubstr("2 relations, 0 of them without"));
}

TEST_F(EvaluateRelations, ClocksThatNeverMeetAreAnErrorThatSaysWhatHelps) {
  const std::string later = "1010 1011 1 0 0 0 0 1.5707963\n";
  const Ran ran = evaluate(later);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("1010.000 s and 1011.000 s"));
  EXPECT_THAT(ran.err, HasSubstr("10.000 s and 12.000 s"));
  EXPECT_THAT(ran.err, HasSubstr("--clock-offset"));
  EXPECT_EQ(evaluate(later, {"--clock-offset", "1000"}).exit_code, 0);
  EXPECT_EQ(evaluate(later, {"--clock-offset", "1000.3"}).exit_code, 3);
  EXPECT_EQ(evaluate(later, {"--clock-offset", "1000.3", "--tolerance", "0.4"}).exit_code, 0);
  const Ran scans = evaluate("7 9 1 0 0\n");
  EXPECT_EQ(scans.exit_code, 3);
  EXPECT_THAT(scans.err, HasSubstr("3 poses"));
}

TEST_F(EvaluateRelations, WordsThatMakeNoSense) {
  EXPECT_EQ(run({"evaluate", poses()}).exit_code, 2);
  EXPECT_EQ(evaluate("10 11 1 0 0 0 0 0\n", {poses()}).exit_code, 2) << "two references";
  for (const char* value : {"nan", "-1", "x", ""})
    EXPECT_EQ(evaluate("10 11 1 0 0 0 0 0\n", {"--tolerance", value}).exit_code, 2) << value;
  for (const char* value : {"nan", "inf", "x", ""})
    EXPECT_EQ(evaluate("10 11 1 0 0 0 0 0\n", {"--clock-offset", value}).exit_code, 2) << value;
  EXPECT_EQ(evaluate("").exit_code, 3);
  const Ran ran = evaluate("10 11 1 0 0 0 0 0\nnonsense\n");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr("a.relations:2"));
  EXPECT_EQ(run({"evaluate", poses(), "--relations", folder.path("missing")}).exit_code, 3);
}

}  // namespace
}  // namespace beaconless
