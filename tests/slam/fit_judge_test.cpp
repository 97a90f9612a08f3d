// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/fit_judge.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

SlamFit fit_of(double on_ratio, double off_ratio) {
  SlamFit fit;
  fit.match.status = MatchStatus::converged;
  fit.overlap = {on_ratio, off_ratio};
  return fit;
}

const Pose2 kHere{};
const Pose2 kNear{0.2, 0.0, radians(5.0)};
const Pose2 kAway{0.5, 0.0, 0.0};
const Pose2 kTurned{0.0, 0.0, radians(25.0)};
const Pose2 kOutOfReach{0.7, 0.0, 0.0};

TEST(FitJudge, WhatIsUsualIsLearntFromFitsThatWereTaken) {
  FitJudge judge(FitJudgeConfig{});
  EXPECT_TRUE(judge.is_in_doubt(fit_of(0.7, 0.05))) << "at first everything is explained";
  for (int i = 0; i < 60; ++i) judge.learn(fit_of(0.7, 0.05));
  EXPECT_FALSE(judge.is_in_doubt(fit_of(0.7, 0.05)));
  EXPECT_TRUE(judge.is_in_doubt(fit_of(0.6, 0.0))) << "less of it is known than usual";
  EXPECT_FALSE(judge.contradicts(fit_of(0.6, 0.0)));
  EXPECT_TRUE(judge.contradicts(fit_of(0.7, 0.16))) << "more of it is where nothing stands than usual";
}

TEST(FitJudge, AFitInDoubtMustBeNear) {
  const FitJudge judge{FitJudgeConfig{}};
  const SlamFit good = fit_of(0.98, 0.02);
  const SlamFit little = fit_of(0.5, 0.01);
  const SlamFit contradicting = fit_of(0.7, 0.2);
  for (const Pose2& place : {kHere, kNear, kAway, kTurned, kOutOfReach}) {
    EXPECT_NE(judge.worth(good, place, {}), FitJudge::kWorthless);
    EXPECT_FALSE(judge.is_surprising(good, place, {}));
  }
  EXPECT_NE(judge.worth(little, kAway, {}), FitJudge::kWorthless);
  EXPECT_TRUE(judge.is_surprising(little, kAway, {}));
  EXPECT_FALSE(judge.is_surprising(little, kNear, {}));
  EXPECT_EQ(judge.worth(little, kOutOfReach, {}), FitJudge::kWorthless);
  EXPECT_NE(judge.worth(contradicting, kNear, {}), FitJudge::kWorthless);
  EXPECT_EQ(judge.worth(contradicting, kAway, {}), FitJudge::kWorthless);
  EXPECT_EQ(judge.worth(contradicting, kTurned, {}), FitJudge::kWorthless);
}

TEST(FitJudge, TheBetterFitIsWorthMoreAndTheNearerOfTwoAlike) {
  const FitJudge judge{FitJudgeConfig{}};
  EXPECT_GT(judge.worth(fit_of(0.95, 0.0), kHere, {}), judge.worth(fit_of(0.9, 0.0), kHere, {}));
  EXPECT_GT(judge.worth(fit_of(0.95, 0.0), kHere, {}), judge.worth(fit_of(0.95, 0.05), kHere, {}));
  EXPECT_GT(judge.worth(fit_of(0.95, 0.0), kNear, {}), judge.worth(fit_of(0.95, 0.0), kAway, {}));
}

TEST(FitJudge, SaysWhyAFitDoesNotHold) {
  const FitJudge judge{FitJudgeConfig{}};
  const auto reason = [&](const SlamFit& fit) {
    return judge.reason_not_held(fit, judge.worth(fit, kHere, {}));
  };
  EXPECT_EQ(reason(fit_of(0.9, 0.1)), "");
  EXPECT_NE(reason(fit_of(0.1, 0.0)), "");
  EXPECT_NE(reason(fit_of(0.5, 0.4)), "");
  SlamFit none = fit_of(0.9, 0.0);
  none.match.status = MatchStatus::too_few_pairs;
  EXPECT_NE(reason(none), "");
  EXPECT_NE(judge.reason_not_held(fit_of(0.9, 0.0), FitJudge::kWorthless), "");
}

}  // namespace
}  // namespace beaconless
