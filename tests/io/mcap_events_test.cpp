// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_events.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/cdr_encode.hpp"
#include "beaconless/io/cdr_message.hpp"
#include "beaconless/io/ros_schemas.hpp"

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

// A heading passes through sine and cosine of its half: a few roundings.
constexpr double kRounding = 1e-14;

std::vector<unsigned char> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

TEST(CdrEncode, SweepsComeBackAsTheSameBits) {
  for (const RawScan& scan : sample_scans(5, 33)) {
    const RawScan read = io::cdr::decode_laser_scan(bytes_of(io::encode_laser_scan(scan))).value();
    // NaN is no equal of itself: compared behind the gate, which keeps every other bit.
    EXPECT_EQ(Scan::make(read).value(), Scan::make(scan).value());
    EXPECT_EQ(read.stamp, scan.stamp);
    EXPECT_EQ(read.intensities, scan.intensities);
  }
}

TEST(CdrEncode, StampsBefore1970AreFloored) {
  RawScan scan;
  scan.stamp.ns = -1;
  EXPECT_EQ(io::cdr::decode_laser_scan(bytes_of(io::encode_laser_scan(scan)))->stamp.ns, -1);
}

TEST(CdrEncode, PosesComeBack) {
  const Pose2 pose{1.5, -2.25, 3.0};
  const Odometry odometry{{5}, pose, Twist2{0.5, 0.25, -1.0}, ""};
  const Odometry read =
      io::cdr::decode_odometry(bytes_of(io::encode_odometry(odometry, "odom", "base"))).value();
  EXPECT_EQ(read.twist_per_s, odometry.twist_per_s);
  EXPECT_EQ(read.odom_from_base.x_m, pose.x_m);
  EXPECT_NEAR(read.odom_from_base.theta_rad, pose.theta_rad, kRounding);
  const auto stamped = io::cdr::decode_pose_stamped(bytes_of(io::encode_pose_stamped({7}, "map", pose)));
  EXPECT_EQ(stamped->stamp.ns, 7);
  EXPECT_EQ(stamped->map_from_base.y_m, pose.y_m);
}

TEST(CdrEncode, TheCovarianceStandsAtXYAndYaw) {
  PoseEstimate estimate;
  estimate.covariance << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  const std::string body = io::encode_pose_with_covariance_stamped(estimate, "map");
  const auto number = [&](std::size_t from_end) {
    double value = 0.0;
    std::memcpy(&value, body.data() + body.size() - 8 * from_end, sizeof(value));
    return value;
  };
  EXPECT_EQ(number(36), 1.0);      // xx
  EXPECT_EQ(number(36 - 1), 2.0);  // xy
  EXPECT_EQ(number(36 - 5), 3.0);  // x yaw
  EXPECT_EQ(number(36 - 7), 4.0);  // yy
  EXPECT_EQ(number(1), 6.0);       // yaw yaw
  EXPECT_EQ(number(36 - 14), 0.0);
}

TEST(Ros2Schema, NamesAllThatAMessageIsMadeOf) {
  for (const char* name : {"sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage",
                           "geometry_msgs/msg/PoseStamped", "diagnostic_msgs/msg/DiagnosticArray"})
    EXPECT_THAT(io::ros2_schema(name), HasSubstr("MSG: builtin_interfaces/Time\nint32 sec\n")) << name;
  EXPECT_EQ(io::ros2_schema("nav_msgs/msg/Path"), "");
}

TEST(McapEvents, EventsComeBackInTheirOrder) {
  const TempFolder folder;
  const auto raw = sample_scans(3, 20);
  {
    io::McapEventWriter file(folder.path("a.mcap"));
    file.write(raw[1], "/front/scan");
    file.write(Odometry{{raw[0].stamp}, {1, 2, 0}, Twist2{1, 2, 3}, "/wheels"});
    file.write(Odometry{{raw[0].stamp}, {1, 2, 0}, std::nullopt, "/tf robot/odom->robot/base"});
    file.write(ReferencePose{{raw[0].stamp}, {1, 2, 0}, std::nullopt, "TRUEPOS"});
    file.write(raw[2], "/front/scan");
  }
  const Pass pass = pass_over(folder.path("a.mcap"));
  ASSERT_FALSE(pass.error) << *pass.error;
  ASSERT_EQ(pass.events.size(), 5U);
  ASSERT_EQ(pass.scans.size(), 2U);
  EXPECT_EQ(pass.scans[0], Scan::make(raw[1]).value());
  EXPECT_EQ(std::get<Odometry>(pass.events[1]),
            (Odometry{raw[0].stamp, {1, 2, 0}, Twist2{1, 2, 3}, "/wheels"}));
  EXPECT_EQ(std::get<Odometry>(pass.events[2]),
            (Odometry{raw[0].stamp, {1, 2, 0}, std::nullopt, "/tf robot/odom->robot/base"}));
  EXPECT_EQ(std::get<ReferencePose>(pass.events[3]),
            (ReferencePose{raw[0].stamp, {1, 2, 0}, std::nullopt, "/reference/truepos"}));
  EXPECT_EQ(std::get<Scan>(pass.events[4]), Scan::make(raw[2]).value());
}

}  // namespace
}  // namespace beaconless
