// SPDX-License-Identifier: Apache-2.0
// Recordings of real robots, kept outside the project: skipped where they are not.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/recording_writer.hpp"

#include "recording_samples.hpp"
#include "same_events.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

struct Known {
  const char* name;
  const char* topic;
  std::size_t scans, odometry, references;
  std::size_t beams;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.name; }

class RealRecording : public testing::TestWithParam<Known> {};

TEST_P(RealRecording, OpensAndCounts) {
  const Known& known = GetParam();
  const std::string path = recorded(known.name);
  if (path.empty()) GTEST_SKIP() << known.name << " is not here; BEACONLESS_DATA names its folder";
  const Pass pass = pass_over(path, {.topic = known.topic});
  ASSERT_FALSE(pass.error) << *pass.error;
  EXPECT_EQ(pass.scans.size(), known.scans);
  EXPECT_EQ(pass.odometry.size(), known.odometry);
  EXPECT_EQ(pass.references.size(), known.references);
  for (const Scan& scan : pass.scans) EXPECT_EQ(scan.size(), known.beams);
  EXPECT_LE(pass.problems.size(), 1U);  // the stamps of some repeat; no record is damaged
}

/// Copies a recording into another format.
std::string copied(const io::Recording& from, const std::string& path) {
  const auto writer =
      io::make_recording_writer(path, {.scan_topic = from.scan_topic(), .laser_place = from.laser_place()});
  if (!writer) return to_string(writer.error());
  for (const Event& event : from) writer.value()->write(event);
  const auto done = writer.value()->finish();
  return done ? "" : to_string(done.error());
}

TEST_P(RealRecording, ACopyOfACopyOfACopyHoldsTheSame) {
  const Known& known = GetParam();
  const std::string path = recorded(known.name);
  if (path.empty()) GTEST_SKIP() << known.name << " is not here; BEACONLESS_DATA names its folder";
  const TempFolder folder;
  const auto first = io::open_recording(path, {.topic = known.topic}).value();
  const bool is_log = first.format() == "CARMEN log";
  std::vector<const char*> names{"1.mcap", "2.db3"};
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
  bool tells_all = true;  // ROS 1 has no time before 1970
  for (const Event& event : first) tells_all = tells_all && stamp_of(event).ns >= 0;
  if (tells_all) names.push_back("3.bag");
#endif
  names.insert(names.end(), {"4.mcap", "5/"});
  std::optional<io::Recording> before(first);
  for (const char* name : names) {
    SCOPED_TRACE(name);
    ASSERT_EQ(copied(*before, folder.path(name)), "");
    const auto copy = io::open_recording(folder.path(name)).value();
    expect_same_events(first, copy, {.sources = !is_log, .frames = !is_log});
    if (first.laser_place() || std::string_view(name) != "1.mcap") {
      ASSERT_EQ(copy.laser_place().has_value(), before->laser_place().has_value());
      if (copy.laser_place()) {
        EXPECT_EQ(copy.laser_place()->told_by, before->laser_place()->told_by);
        expect_near(copy.laser_place()->base_from_laser, before->laser_place()->base_from_laser);
      }
    }
    before = copy;
  }
}

// Counted by `zgrep -c` in the logs and by `rosbag info` in the bags.
INSTANTIATE_TEST_SUITE_P(
    Logs, RealRecording,
    testing::Values(Known{"sim_rooms/a1_static.carmen.log.gz", "", 400, 0, 400, 1081},
                    Known{"sim_rooms/b1_ellipse.carmen.log.gz", "", 2000, 0, 2000, 1081},
                    Known{"fr079/freiburg-079-corrected.log.gz", "", 4791, 9725, 4791, 360},
                    Known{"fr079/flirtlib-fr079.log.gz", "", 1464, 0, 1464, 360},
                    Known{"mit_csail/csail-corrected.log.gz", "", 406, 2394, 406, 361},
                    Known{"mit_csail/flirtlib-mit-csail.log.gz", "", 1051, 0, 1051, 361},
                    Known{"mit_csail/csail.corrected.gfs.gz", "", 406, 1988, 406, 361},
                    Known{"radish/aces-corrected.log.gz", "", 440, 7814, 440, 180},
                    Known{"radish/belgioioso-corrected.log.gz", "", 395, 4442, 395, 361},
                    Known{"radish/freiburg-101-corrected.log.gz", "", 292, 4569, 292, 360},
                    Known{"radish/seattle-corrected.log.gz", "", 241, 19311, 241, 361},
                    Known{"wean_hall/robotdata2.carmen.log.gz", "FLASER", 2251, 3126, 2251, 180},
                    Known{"wean_hall/robotdata4.carmen.log.gz", "", 600, 823, 600, 180},
                    Known{"duke_loop5/loop5.carmen.log.gz", "", 551, 551, 551, 181},
                    Known{"malaga/localization_demo.carmen.log.gz", "", 37, 0, 37, 361},
                    Known{"jarvis/jarvis_circular_nav350_utm30lx_crop.carmen.log.gz", "", 204, 0, 204, 1081},
                    Known{"jarvis/jarvis_circular_s3000.carmen.log.gz", "", 213, 0, 213, 761}));

INSTANTIATE_TEST_SUITE_P(Ros2, RealRecording,
                         testing::Values(Known{"turtlebot4/macfirst_floor_take_2", "", 357, 2826, 0, 720}));

INSTANTIATE_TEST_SUITE_P(Bags, RealRecording,
                         testing::Values(Known{"jarvis/jarvis_circular_path_fast.bag",
                                               "/driver_laser_navigation/laser_scan", 204, 638, 408, 1440},
                                         Known{"jarvis/jarvis_circular_path_fast.bag",
                                               "driver_laser_security/laser_scan", 213, 638, 408, 761},
                                         Known{"hand_carried/laser_scan_matcher_demo.bag", "", 360, 0, 0,
                                               681}));

TEST(RealRecordings, TheOldBagIsRefusedByName) {
  const std::string path = recorded("hand_carried/splitter_demo_v1.2.bag");
  if (path.empty()) GTEST_SKIP() << "the bag is not here; BEACONLESS_DATA names its folder";
  const Pass pass = pass_over(path);
  ASSERT_TRUE(pass.error);
  EXPECT_THAT(to_string(*pass.error), testing::AnyOf(HasSubstr("V1.2"), HasSubstr("without reading them")));
}

TEST(RealRecordings, FlaserAndItsRobotlaserTwinAgreeOnTheAngles) {
  const std::string old_form = recorded("fr079/freiburg-079-corrected.log.gz");
  const std::string new_form = recorded("fr079/flirtlib-fr079.log.gz");
  if (old_form.empty() || new_form.empty())
    GTEST_SKIP() << "fr079 is not here; BEACONLESS_DATA names its folder";
  const Pass deduced = pass_over(old_form);
  const Pass told = pass_over(new_form);
  ASSERT_FALSE(deduced.scans.empty() || told.scans.empty());
  // The log prints six decimals: 360 steps of half a millionth.
  EXPECT_NEAR(deduced.scans[0].angle_min_rad(), told.scans[0].angle_min_rad(), 1e-6);
  EXPECT_NEAR(deduced.scans[0].angle_rad(359), told.scans[0].angle_rad(359), 360 * 0.5e-6);
}

}  // namespace
}  // namespace beaconless
