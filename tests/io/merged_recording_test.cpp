// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/merged_recording.hpp"

#include <gmock/gmock.h>

#include "tests/apps/kept_recording.hpp"

namespace beaconless::io {
namespace {

using testing::ElementsAre;

Scan scan_of(const std::string& frame, double seconds_s) {
  return Scan::make({.stamp = Stamp::from_seconds(seconds_s),
                     .frame_id = frame,
                     .angle_increment_rad = 0.1F,
                     .range_max_m = 30.0F,
                     .ranges_m = {1.0F, 2.0F}})
      .value();
}

Event odometry_at(double seconds_s) { return Odometry{Stamp::from_seconds(seconds_s), {}, {}, "ODOM"}; }

/// "front 1.0" for each event.
std::vector<std::string> told_by(const Recording& recording) {
  std::vector<std::string> told;
  for (const Event& event : recording) {
    const auto* scan = std::get_if<Scan>(&event);
    told.push_back((scan != nullptr ? scan->frame_id() : "odometry") + " " +
                   to_string(stamp_of(event)).substr(0, 3));
  }
  return told;
}

Recording front() {
  return recording_of({scan_of("front", 1.0), odometry_at(1.2), scan_of("front", 2.0), scan_of("front", 3.0),
                       odometry_at(3.2)});
}

Recording rear() {
  return recording_of({scan_of("rear", 1.1), odometry_at(1.2), scan_of("rear", 2.1), odometry_at(3.2)});
}

TEST(MergedRecording, ComesByItsStampsAndTellsOdometryOnce) {
  const Recording both = merge_recordings({{front(), "front"}, {rear(), "rear"}}, {});
  const std::vector<std::string> expected{"front 1.0", "rear 1.1",  "odometry 1.2", "front 2.0",
                                          "rear 2.1",  "front 3.0", "odometry 3.2"};
  EXPECT_EQ(told_by(both), expected);
  EXPECT_EQ(told_by(both), expected) << "a second pass is another";
}

TEST(MergedRecording, SelectsAmongTheScansOfEach) {
  const Recording both =
      merge_recordings({{front(), "front"}, {rear(), "rear"}}, ScanSelection::parse("1::2").value());
  EXPECT_THAT(told_by(both), ElementsAre("odometry 1.2", "front 2.0", "rear 2.1", "odometry 3.2"));
}

TEST(MergedRecording, GoesOnWhereOneEnds) {
  const Recording both =
      merge_recordings({{front(), "front"}, {recording_of({scan_of("rear", 9.0)}), "rear"}}, {});
  EXPECT_EQ(told_by(both).back(), "rear 9.0");
  EXPECT_EQ(told_by(both).size(), 6U);
}

TEST(MergedRecording, PassesOverScansThatCouldBeThoseOfAnother) {
  const auto strange = recording_of({scan_of("rear", 1.1), scan_of("front", 1.2), scan_of("other", 1.3)});
  std::vector<std::string> problems;
  const Recording both = merge_recordings({{front(), "front"}, {strange, "rear"}}, {},
                                          [&](const Problem& problem) { problems.push_back(problem.what); });
  EXPECT_THAT(told_by(both),
              ElementsAre("front 1.0", "rear 1.1", "odometry 1.2", "front 2.0", "front 3.0", "odometry 3.2"));
  EXPECT_THAT(problems, ElementsAre(testing::HasSubstr("\"front\""), testing::HasSubstr("\"other\"")));
  const auto pass = both.open_pass();
  while (pass->next()) {
  }
  EXPECT_EQ(pass->skipped(), 2U);
}

}  // namespace
}  // namespace beaconless::io
