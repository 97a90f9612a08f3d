// SPDX-License-Identifier: Apache-2.0
// Switching off and on, the black box, and what is told of a robot that is not found.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>

#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/last_pose.hpp"
#include "beaconless/io/yaml_tree.hpp"

#include "apps/beaconless/replay.hpp"
#include "tests/apps/drive.hpp"
#include "tests/apps/fake_localizer.hpp"
#include "tests/apps/kept_recording.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class LostAndFound : public Drive {
 protected:
  Words localize_from(const std::string& start) const {
    return {"localize", recording(), "--map", plan(), "--base-from-laser", "0.7,0,0", "--start", start};
  }
  /// The boxes of a run, in order of time.
  std::vector<std::string> boxes() const {
    std::vector<std::string> folders;
    if (std::filesystem::exists(folder.path("boxes")))
      for (const auto& entry : std::filesystem::directory_iterator(folder.path("boxes")))
        folders.push_back(entry.path().string());
    std::sort(folders.begin(), folders.end());
    return folders;
  }

  /// A drive during which, from a scan on, walls between one and two metres away are two metres further.
  std::string changed_drive(const std::string& log_gz, std::size_t from_scan) const {
    std::istringstream lines(run_program(folder, "/usr/bin/gzip", {"-dc", log_gz}).out);
    std::string log;
    std::size_t scans = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("RAWLASER1") && ++scans > from_scan)
        for (std::size_t at = 0; (at = line.find(" 1.", at)) != std::string::npos;) line[at + 1] = '3';
      log += line + "\n";
    }
    EXPECT_GT(scans, from_scan);
    return folder.write("changed.log", log);
  }

  using Estimates = std::vector<PoseEstimate>;

  /// The estimates of the first box that a run writes, and those of the box replayed as it says.
  std::pair<Estimates, Estimates> box_and_replay(const std::string& drive, const std::string& map,
                                                 const std::string& poses) const {
    const Ran ran = run({"localize", drive, "--map", map, "--base-from-laser", "0.7,0,0", "--start-from",
                         poses, "--set", "health.lost_after_scans=3", "--blackbox", folder.path("boxes")});
    if (boxes().empty()) ADD_FAILURE() << testing::PrintToString(ran);
    if (boxes().empty()) return {};
    const std::string box = boxes().front();
    EXPECT_THAT(ran.err, testing::HasSubstr("black box: " + box));
    const auto why = io::read_yaml(box + "/why.yaml").value();
    const Ran again =
        run({"localize", box + "/recording.log", "--map", why.find("map")->text, "--config",
             box + "/config.yaml", "--start=" + why.find("start")->text, "--out", folder.path("again")});
    EXPECT_EQ(again.exit_code, 4) << again.err;
    return {io::read_estimates_csv(box + "/estimates.csv").value(),
            io::read_estimates_csv(folder.path("again/estimates.csv")).value()};
  }
};

TEST_F(LostAndFound, APoseThatWasSavedIsGoneOnFrom) {
  const std::string pose = folder.path("pose.yaml");
  const Ran first = run(localize() + Words{"--scans", ":20", "--save-pose", pose, "--out", folder.path("a")});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto last = io::read_last_pose(pose).value();
  const auto estimates = io::read_estimates_csv(folder.path("a/estimates.csv")).value();
  EXPECT_EQ(last.map_from_base, estimates.back().map_from_base);
  EXPECT_EQ(last.stamp, estimates.back().stamp);

  const Ran second = run(localize_from("resume:" + pose) + Words{"--scans", "20:", "--reference", truth(),
                                                                 "--out", folder.path("b"), "--json"});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.json()["status_counts"], (nlohmann::json{{"ok", 20}}));
  EXPECT_LT(second.json()["error"]["position_m"]["max"], 0.01);
  EXPECT_THAT(second.err, Not(HasSubstr("searched everywhere")));
  EXPECT_THAT(second.err, Not(HasSubstr("older")));
}

TEST_F(LostAndFound, APoseOfAnotherMapIsRefused) {
  const std::string pose = folder.path("pose.yaml");
  ASSERT_EQ(run(localize() + Words{"--scans", ":5", "--save-pose", pose}).exit_code, 0);
  const Ran other =
      run({"localize", recording(), "--map", folder.path("elsewhere.yaml"), "--start", "resume:" + pose});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.err, HasSubstr("the pose is one on the map plan.yaml, not on elsewhere.yaml"));
  folder.write("sim/plan.yaml", folder.read("sim/plan.yaml") + "# repainted\n");
  const Ran changed = run(localize_from("resume:" + pose));
  EXPECT_EQ(changed.exit_code, 3);
  EXPECT_THAT(changed.err, HasSubstr("the map has changed"));
  EXPECT_EQ(run(localize_from("resume:" + folder.path("gone.yaml"))).exit_code, 3);
}

TEST_F(LostAndFound, AnOldPoseIsToldAndAWrongOneIsSearchedFor) {
  const std::string path = folder.path("pose.yaml");
  ASSERT_EQ(run(localize() + Words{"--scans", ":5", "--save-pose", path}).exit_code, 0);
  io::LastPose pose = io::read_last_pose(path).value();
  pose.stamp = pose.stamp + -3.0 * 86400.0;
  pose.map_from_base = {7.0, 2.6, 1.0};
  ASSERT_TRUE(io::write_last_pose(path, pose));
  const Ran ran = run(localize_from("resume:" + path));
  EXPECT_THAT(ran.err, HasSubstr("3 days older than the first scan"));
  EXPECT_THAT(ran.err, HasSubstr("searched everywhere"));
}

TEST_F(LostAndFound, OfARobotThatIsNeverFoundIsToldWhatToDoByHowItWasStarted) {
  const auto told = [&](const std::string& start) {
    const Ran ran = run({"localize", recording(), "--map", folder.path("elsewhere.yaml"), "--start", start});
    EXPECT_EQ(ran.exit_code, 4) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("never found"));
    return ran.err;
  };
  EXPECT_THAT(told("80,80,0"), HasSubstr("check the start pose"));
  EXPECT_THAT(told("auto"), testing::AllOf(Not(HasSubstr("check the start pose")), HasSubstr("drive on")));
  EXPECT_THAT(told("near:51,52,3"), testing::AllOf(HasSubstr("check the region"), HasSubstr("--start auto")));
}

TEST_F(LostAndFound, ARegionOffTheMapIsRefused) {
  for (const char* start :
       {"near:3,2,2", "near:49,49,1.4"}) {  // the second reaches the map's corner not quite
    const Ran ran = run({"localize", recording(), "--map", folder.path("elsewhere.yaml"), "--start", start});
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_THAT(ran.err, HasSubstr("--start: \"" + std::string(start) + "\" lies wholly off the map"));
    EXPECT_THAT(ran.err, HasSubstr("50.0,50.0 and 53.0,54.0"));
  }
  EXPECT_EQ(
      run({"localize", recording(), "--map", folder.path("elsewhere.yaml"), "--start", "near:49,49,1.5"})
          .exit_code,
      4)
      << "it reaches the map, but the robot is not there";
}

TEST_F(LostAndFound, DisksThatRefuseDoNotStopTheRun) {
  folder.write("file", "no folder");
  const Ran ran = run(localize() + Words{"--save-pose", folder.path("file/pose.yaml"), "--blackbox",
                                         folder.path("file/boxes")});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr("the last pose is not saved"));
  EXPECT_THAT(ran.out, HasSubstr("40 scans by walls: 40 ok"));
}

TEST_F(LostAndFound, ABoxReplaysTheRunThatWroteIt) {
  const auto [then, now] = box_and_replay(changed_drive(recording(), 20), plan(), truth());
  EXPECT_EQ(now, then) << "from the beginning of a run: bit for bit";
}

TEST_F(LostAndFound, ABoxFromTheMiddleOfARunComesToAgreeWithIt) {
  std::string scenario = folder.read("drive.yaml");
  scenario.replace(scenario.find("duration_s: 1"), 13, "duration_s: 35");
  const Ran simulated = run({"simulate", folder.write("long.yaml", scenario), "--out", folder.path("long")});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto [then, now] = box_and_replay(changed_drive(folder.path("long/recording.log.gz"), 1380),
                                          folder.path("long/plan.yaml"), folder.path("long/truth.tum"));
  ASSERT_EQ(then.size(), 1200U) << "half a minute at 40 Hz";
  ASSERT_EQ(now.size(), then.size());
  for (std::size_t i = 0; i < then.size(); ++i) {
    EXPECT_EQ(now[i].stamp, then[i].stamp);
    EXPECT_EQ(now[i].status, then[i].status) << i;
    EXPECT_LT(distance_m(now[i].map_from_base, then[i].map_from_base), i < 10 ? 1e-4 : 1e-8) << i;
  }
}

cli::Replay replayed(FakeLocalizer& localizer, std::size_t scans) {
  localizer.start_anywhere({});
  return cli::replay(recording_of(drive_of(scans)), {}, localizer, {}, cli::Console{.quiet = true});
}

TEST(ReplayPlaces, KeepsTheFirstAndTheLastOfEverySearch) {
  const auto places = [](double x_m) {
    return std::vector<PoseCandidate>{{{x_m, 0.0, 0.0}, 0.9, 0.6}, {{-x_m, 0.0, 0.0}, 0.8, 0.4}};
  };
  FakeLocalizer localizer;
  localizer.after_start_anywhere = {
      {Status::relocalizing, {}, 0.0, places(1.0)}, {Status::relocalizing, {}, 0.0, places(2.0)},
      {Status::relocalizing, {}, 0.0, places(3.0)}, {Status::ok},
      {Status::relocalizing, {}, 0.0, places(4.0)}, {Status::ok},
      {Status::relocalizing, {}, 0.0, places(5.0)}, {Status::relocalizing, {}, 0.0, places(6.0)}};
  const auto run = replayed(localizer, 8);
  std::vector<double> at;
  for (const auto& fitted : run.places) at.push_back(fitted.places.front().map_from_base.x_m);
  EXPECT_THAT(at, testing::ElementsAre(1.0, 3.0, 4.0, 5.0, 6.0));
  EXPECT_EQ(run.places[1].scan_index, 2U);
  EXPECT_THAT(run.places[1].places, SizeIs(2));
  EXPECT_THAT(run.good_scans, SizeIs(2)) << "only those at poses that are ok";
}

TEST(ReplayPlaces, KeepsFewOfALongRun) {
  FakeLocalizer localizer;
  localizer.after_start_anywhere.clear();
  for (int i = 0; i < 1000; ++i)
    localizer.after_start_anywhere.push_back({i % 2 == 0 ? Status::relocalizing : Status::ok,
                                              {},
                                              0.0,
                                              std::vector<PoseCandidate>(i % 2 == 0 ? 500U : 0U)});
  const auto run = replayed(localizer, 1000);
  EXPECT_LE(run.places.size(), 60U);
  EXPECT_GE(run.places.size(), 40U);
  EXPECT_THAT(run.places.front().places, SizeIs(20));
  EXPECT_EQ(run.places.front().place_count, 500U);
  EXPECT_LT(run.good_scans.size(), 81U);
}

}  // namespace
}  // namespace beaconless
