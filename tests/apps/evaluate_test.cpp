// SPDX-License-Identifier: Apache-2.0
// What `beaconless evaluate` promises, and that it says what the library says.
#include "beaconless/eval/evaluate.hpp"

#include <set>

#include <gmock/gmock.h>

#include "beaconless/eval/crb.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::Not;

std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

nlohmann::json as_told(const eval::Statistics& s) {
  return {{"mean", s.mean}, {"rmse", s.rmse},     {"sd", s.sd},  {"max", s.max},
          {"min", s.min},   {"median", s.median}, {"p95", s.p95}};
}

/// A localized drive, and what is said about it.
class Evaluate : public Drive {
 protected:
  void SetUp() override {
    Drive::SetUp();
    ASSERT_EQ(run(localize() + Words{"--reference", truth(), "--out", folder.path("run")}).exit_code, 0);
  }
  std::string trajectory() const { return folder.path("run/trajectory.tum"); }
  Words evaluate(const Words& more = {}) const { return Words{"evaluate", trajectory(), truth()} + more; }
};

TEST_F(Evaluate, JsonHasThePromisedKeysAndNoOthers) {
  const auto told = run(evaluate({"--json"})).json();
  EXPECT_EQ(keys_of(told), (std::set<std::string>{"pairs", "unmatched", "position_m", "heading_deg",
                                                  "aligned", "crb_ratio"}));
  const std::set<std::string> columns{"mean", "rmse", "sd", "max", "min", "median", "p95"};
  EXPECT_EQ(keys_of(told["position_m"]), columns);
  EXPECT_EQ(keys_of(told["heading_deg"]), columns);
  EXPECT_EQ(keys_of(told["aligned"]), (std::set<std::string>{"position_m", "heading_deg"}));
  EXPECT_EQ(keys_of(told["aligned"]["position_m"]), columns);
  EXPECT_EQ(keys_of(told["aligned"]["heading_deg"]), columns);
  EXPECT_TRUE(told["crb_ratio"].is_null());
}

TEST_F(Evaluate, SaysWhatTheLibrarySays) {
  const auto told = run(evaluate({"--json"})).json();
  const eval::Evaluation evaluation =
      eval::evaluate(io::read_tum(trajectory()).value(), io::read_tum(truth()).value());
  EXPECT_EQ(told["pairs"], evaluation.errors.size());
  EXPECT_EQ(told["pairs"], kScans);
  EXPECT_EQ(told["position_m"], as_told(evaluation.raw.position_m));
  EXPECT_EQ(told["heading_deg"], as_told(evaluation.raw.heading_deg));
  EXPECT_EQ(told["aligned"]["position_m"], as_told(evaluation.aligned.position_m));
  EXPECT_EQ(told["aligned"]["heading_deg"], as_told(evaluation.aligned.heading_deg));
}

TEST_F(Evaluate, AndWhatTheSummaryOfTheRunSays) {
  const auto told = run(evaluate({"--json", "--map", plan(), "--base-from-laser", "0.7,0,0"})).json();
  const auto summary = nlohmann::json::parse(folder.read("run/summary.json"))["error"];
  EXPECT_EQ(keys_of(told), keys_of(summary));
  // A TUM file rounds to nine decimals: half a nanometre in x and y, and 1e-9 rad at most.
  for (const auto& [column, value] : told["position_m"].items())
    EXPECT_NEAR(value.get<double>(), summary["position_m"][column].get<double>(), 1e-9) << column;
  for (const auto& [column, value] : told["heading_deg"].items())
    EXPECT_NEAR(value.get<double>(), summary["heading_deg"][column].get<double>(), 2e-7) << column;
}

TEST_F(Evaluate, BoundIsThatOfThePlanTheSigmaAndTheScanner) {
  const auto told =
      run(evaluate({"--json", "--map", plan(), "--sigma", "0.02", "--base-from-laser", "0.7,0,0"})).json();
  const auto evaluation = eval::evaluate(io::read_tum(trajectory()).value(), io::read_tum(truth()).value());
  const auto map = io::read_map(plan()).value();
  const auto bounds = eval::accuracy_bounds(RayCaster(std::get<FloorPlan>(map).segments()),
                                            eval::utm_30lx(0.02), {0.7, 0.0, 0.0}, evaluation.errors);
  const auto ratio = eval::crb_ratio(evaluation.errors, bounds);
  ASSERT_TRUE(ratio);
  EXPECT_DOUBLE_EQ(told["crb_ratio"]["position"].get<double>(), ratio->position);
  EXPECT_DOUBLE_EQ(told["crb_ratio"]["heading"].get<double>(), ratio->heading);
  // The bound is proportional to sigma, so the ratio is to its inverse.
  const auto halved =
      run(evaluate({"--json", "--map", plan(), "--sigma", "0.01", "--base-from-laser", "0.7,0,0"})).json();
  EXPECT_NEAR(halved["crb_ratio"]["position"].get<double>(), 2.0 * ratio->position, 1e-9);
  EXPECT_NEAR(halved["crb_ratio"]["heading"].get<double>(), 2.0 * ratio->heading, 1e-9);
  // The recording's scanner is the same UTM-30LX up to the float of its angles and limits.
  const auto scanner = run(evaluate({"--json", "--map", plan(), "--sigma", "0.02", "--base-from-laser",
                                     "0.7,0,0", "--recording", recording()}))
                           .json();
  EXPECT_NEAR(scanner["crb_ratio"]["position"].get<double>(), ratio->position, 1e-3 * ratio->position);
}

TEST_F(Evaluate, AlignmentUndoesARigidMotion) {
  const Pose2 elsewhere{3.0, -2.0, 0.5};
  std::vector<StampedPose> moved;
  for (const StampedPose& at : io::read_tum(truth()).value())
    moved.push_back({at.stamp, elsewhere * at.pose});
  ASSERT_TRUE(io::write_tum(folder.path("moved.tum"), Trajectory(moved)).ok());
  const Words words{"evaluate", folder.path("moved.tum"), truth()};
  const auto told = run(words + Words{"--json"}).json();
  EXPECT_NEAR(told["heading_deg"]["mean"].get<double>(), degrees(0.5), 1e-6);
  EXPECT_GT(told["position_m"]["min"].get<double>(), 1.0);
  // What nine decimals leave: 1e-9 m, and that over the drive's half metre in heading.
  EXPECT_LT(told["aligned"]["position_m"]["max"].get<double>(), 1e-8);
  EXPECT_LT(told["aligned"]["heading_deg"]["max"].get<double>(), 1e-6);
  EXPECT_THAT(run(words).out, Not(HasSubstr("after rigid alignment")));
  EXPECT_THAT(run(words + Words{"--align"}).out, HasSubstr("after rigid alignment"));
}

TEST_F(Evaluate, EstimatesBringTheirCovariance) {
  const auto told = run({"evaluate", folder.path("run/estimates.csv"), truth(), "--json"}).json();
  EXPECT_EQ(keys_of(told["nees"]), (std::set<std::string>{"mean", "low", "high"}));
  EXPECT_LT(told["nees"]["low"], 3.0);
  EXPECT_GT(told["nees"]["high"], 3.0);
  EXPECT_EQ(told["pairs"], kScans);
}

TEST_F(Evaluate, ClocksThatNeverMeetAreAnError) {
  const std::string later = folder.write("later.tum", "1000 0 0 0 0 0 0 1\n1001 0 0 0 0 0 0 1\n");
  const Ran ran = run({"evaluate", trajectory(), later, "--json"});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr("clock"));
}

TEST_F(Evaluate, NumbersOfTheCallMustBeNumbers) {
  for (const char* option : {"--sigma", "--max-gap"}) {
    for (const char* value : {"nan", "inf", "0", "-1", "x", ""})
      EXPECT_EQ(run(evaluate({option, value})).exit_code, 2) << option << " " << value;
  }
  EXPECT_EQ(run(evaluate({"--base-from-laser", "nan,0,0"})).exit_code, 2);
}

}  // namespace
}  // namespace beaconless
