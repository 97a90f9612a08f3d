// SPDX-License-Identifier: Apache-2.0
// `--windows`: every window is found by itself, and what became of it is judged.
#include <gmock/gmock.h>

#include "apps/beaconless/window_outcomes.hpp"
#include "tests/apps/drive.hpp"
#include "tests/apps/fake_localizer.hpp"
#include "tests/apps/kept_recording.hpp"

namespace beaconless::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

WindowsReplay replayed(FakeLocalizer& localizer, const Windows& windows, std::size_t scans,
                       const char* selection = "") {
  return replay_windows(recording_of(drive_of(scans)), io::ScanSelection::parse(selection).value(), localizer,
                        {SearchRegion{{1.0, 2.0}, 3.0}}, windows, Console{.quiet = true});
}

std::vector<double> seconds_of(const std::vector<Stamp>& stamps) {
  std::vector<double> seconds;
  for (const Stamp stamp : stamps) seconds.push_back(stamp.seconds());
  return seconds;
}

TEST(WindowsReplay, StartsAnywhereBeforeEachAndLeavesOutWhatIsNotFull) {
  FakeLocalizer localizer;
  const auto run = replayed(localizer, {2, 3}, 10);
  ASSERT_EQ(localizer.searches.size(), 3U);
  ASSERT_TRUE(localizer.searches[2]);
  EXPECT_EQ(localizer.searches[2]->radius_m, 3.0);
  EXPECT_TRUE(localizer.starts.empty());
  EXPECT_THAT(seconds_of(localizer.scans[0]), ElementsAre(0, 1));
  EXPECT_THAT(seconds_of(localizer.scans[1]), ElementsAre(3, 4));
  EXPECT_THAT(seconds_of(localizer.scans[2]), ElementsAre(6, 7));
  EXPECT_EQ(localizer.odometry_count, 3U) << "of those between a window's scans";
  EXPECT_EQ(run.windows[1].first_scan, 3U);
  EXPECT_EQ(run.windows[1].last_scan, 4U);
  EXPECT_EQ(run.windows[1].estimate.stamp, Stamp::from_seconds(4.0));
}

TEST(WindowsReplay, WindowsMayOverlap) {
  FakeLocalizer localizer;
  replayed(localizer, {3, 1}, 5);
  ASSERT_EQ(localizer.scans.size(), 3U);
  EXPECT_THAT(seconds_of(localizer.scans[0]), ElementsAre(0, 1, 2));
  EXPECT_THAT(seconds_of(localizer.scans[1]), ElementsAre(1, 2, 3));
  EXPECT_THAT(seconds_of(localizer.scans[2]), ElementsAre(2, 3, 4));
}

TEST(WindowsReplay, CountsTheScansThatTheSelectionTakes) {
  FakeLocalizer localizer;
  const auto run = replayed(localizer, {2, 2}, 12, "1::3");
  ASSERT_EQ(localizer.scans.size(), 2U);
  EXPECT_THAT(seconds_of(localizer.scans[0]), ElementsAre(1, 4));
  EXPECT_THAT(seconds_of(localizer.scans[1]), ElementsAre(7, 10));
  EXPECT_EQ(run.windows[1].last_scan, 10U);
  EXPECT_TRUE(replayed(localizer, {20, 1}, 12).windows.empty());
}

WindowFound found(Status status, const Pose2& pose, std::vector<PoseCandidate> candidates = {}) {
  WindowFound window{.first_scan = 3, .last_scan = 7, .estimate = {}, .candidates = std::move(candidates)};
  window.estimate.status = status;
  window.estimate.map_from_base = pose;
  window.estimate.stamp = Stamp::from_seconds(1.0);
  return window;
}

TEST(WindowOutcomes, OkIsCorrectWithinThreeDecimetresAndDegrees) {
  PosesOf reference;
  reference.trajectory.add(Stamp::from_seconds(0.5), Pose2{1.0, 2.0, 3.1});
  reference.trajectory.add(Stamp::from_seconds(1.5), Pose2{1.0, 2.0, 3.1});
  const PoseCandidate right{{1.1, 2.0, 3.1}, 0.9, 0.5};
  const PoseCandidate other{{9.0, 2.0, 3.1}, 0.9, 0.5};
  const auto windows =
      judge_windows({found(Status::ok, {1.29, 2.0, 3.1}), found(Status::ok, {1.31, 2.0, 3.1}),
                     found(Status::ok, {1.0, 2.0, 3.1 + radians(2.9) - 2.0 * kPi}),
                     found(Status::ok, {1.0, 2.0, 3.1 + radians(3.1)}),
                     found(Status::relocalizing, {9.0, 2.0, 3.1}, {other, right}),
                     found(Status::relocalizing, {9.0, 2.0, 3.1}, {other}), found(Status::lost, {}),
                     found(Status::degraded, {1.0, 2.0, 3.1}), found(Status::not_started, {})},
                    &reference);
  std::vector<Outcome> outcomes;
  for (const JudgedWindow& window : windows) outcomes.push_back(window.outcome);
  EXPECT_THAT(outcomes, ElementsAre(Outcome::correct, Outcome::wrong, Outcome::correct, Outcome::wrong,
                                    Outcome::ambiguous, Outcome::ambiguous, Outcome::lost, Outcome::degraded,
                                    Outcome::untold));
  const auto summary = summary_of(windows, {5, 20});
  EXPECT_EQ(summary["outcomes"]["correct"], 2);
  EXPECT_EQ(summary["outcomes"]["ambiguous"], 2);
  EXPECT_EQ(summary["ambiguous_with_truth"], 1);
  ASSERT_EQ(summary["wrong"].size(), 2U);
  EXPECT_EQ(summary["wrong"][0]["scan"], 7);
  EXPECT_NEAR(summary["wrong"][0]["position_m"].get<double>(), 0.31, 1e-9);
  const auto lines = lines_of(windows, true);
  EXPECT_THAT(lines.front(), HasSubstr("9 windows: 2 correct, 2 wrong, 2 ambiguous"));
  EXPECT_THAT(lines[2], HasSubstr("wrong but ok: scan 7 at 1.000000000 s, 0.31 m"));
  EXPECT_EQ(lines.size(), 4U);
}

TEST(WindowOutcomes, WithoutAReferenceOkIsNotCalledCorrect) {
  const auto windows = judge_windows({found(Status::ok, {})}, nullptr);
  EXPECT_EQ(windows.front().outcome, Outcome::untold);
  EXPECT_TRUE(lines_of(windows, false).empty());
  EXPECT_THAT(csv_of(windows), HasSubstr("\n3,7,1.000000000,0,0,0,ok,0,untold,,,0,"));
}

using Localize = Drive;

TEST_F(Localize, WindowsNeedAStartWithoutAPose) {
  for (const Words& start :
       {Words{"--start", "1,2,3"}, Words{"--start-from", truth()}, Words{"--start", "resume:x"}}) {
    const Ran ran = run(Words{"localize", recording(), "--map", plan(), "--windows", "5:20"} + start);
    EXPECT_EQ(ran.exit_code, 2) << start.back();
    EXPECT_THAT(ran.err, HasSubstr("--windows")) << start.back();
  }
}

TEST_F(Localize, WindowsLongerThanTheRecordingAreTold) {
  const Ran ran = run({"localize", recording(), "--map", plan(), "--start", "auto", "--windows", "41:1",
                       "--out", folder.path("run")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr("shorten --windows"));
}

TEST_F(Localize, WindowsAreCountedAndListed) {
  const Ran ran =
      run({"localize", recording(), "--map", plan(), "--start", "auto", "--windows", "5:10", "--reference",
           truth(), "--base-from-laser", "0.7,0,0", "--out", folder.path("run"), "--json"});
  EXPECT_THAT(ran.exit_code, testing::AnyOf(0, 4)) << ran.err;
  const auto windows = ran.json()["windows"];
  EXPECT_EQ(windows["count"], 4);
  std::size_t sum = 0;
  for (const auto& count : windows["outcomes"]) sum += count.get<std::size_t>();
  EXPECT_EQ(sum, 4U);
  EXPECT_EQ(windows["outcomes"]["wrong"], 0);
  EXPECT_THAT(folder.read("run/windows.csv"), HasSubstr("\n10,14,"));
}

}  // namespace
}  // namespace beaconless::cli
