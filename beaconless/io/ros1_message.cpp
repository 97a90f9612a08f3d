// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros1_message.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "beaconless/io/quaternion_yaw.hpp"

namespace beaconless::io {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are copied as they lie");

constexpr std::size_t kCovarianceBytes = 36 * sizeof(double);

/// Takes values from the front of a message. After the first that does not fit all are zero, and ok() is
/// false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const unsigned char> bytes) : rest_(bytes) {}

  template <class T>
  T take() {
    T value{};
    if (const auto bytes = take_bytes(sizeof(T)); !bytes.empty())
      std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  std::string text() {
    const auto bytes = take_bytes(take<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }

  std::vector<float> floats() {
    const auto bytes = take_bytes(std::uint64_t{take<std::uint32_t>()} * sizeof(float));
    std::vector<float> values(bytes.size() / sizeof(float));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  void skip(std::size_t count) { take_bytes(count); }
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && rest_.empty(); }

 private:
  std::span<const unsigned char> take_bytes(std::uint64_t count) {
    ok_ = ok_ && count <= rest_.size();
    if (!ok_) return {};
    const auto bytes = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(static_cast<std::size_t>(count));
    return bytes;
  }

  std::span<const unsigned char> rest_;
  bool ok_ = true;
};

struct Header {
  Stamp stamp;
  std::string frame_id;
};

Header take_header(ByteReader& in) {
  Header header;
  in.skip(sizeof(std::uint32_t));  // seq
  const auto seconds = in.take<std::uint32_t>();
  const auto nanos = in.take<std::uint32_t>();
  header.stamp.ns = std::int64_t{seconds} * 1'000'000'000 + nanos;
  header.frame_id = in.text();
  return header;
}

/// A pose or a transform; the plane's part of it, NaN heading where the quaternion says nothing.
Pose2 take_pose(ByteReader& in) {
  const auto x = in.take<double>();
  const auto y = in.take<double>();
  in.skip(sizeof(double));
  const auto qx = in.take<double>();
  const auto qy = in.take<double>();
  const auto qz = in.take<double>();
  const auto qw = in.take<double>();
  return {x, y, yaw_rad_of_quaternion(qx, qy, qz, qw).value_or(std::nan(""))};
}

Error ends_early() { return {"", "the message is shorter or longer than its own lengths tell", ""}; }
Error no_pose() { return {"", "the pose is not finite or has no heading", ""}; }

Result<ReferencePose> decode_pose(std::span<const unsigned char> bytes, std::size_t bytes_after) {
  ByteReader in(bytes);
  const Header header = take_header(in);
  const Pose2 pose = take_pose(in);
  in.skip(bytes_after);
  if (!in.at_end()) return ends_early();
  if (!pose.is_finite()) return no_pose();
  return ReferencePose{header.stamp, pose, std::nullopt, ""};
}

bool is_odom_frame(std::string_view frame) {
  const std::size_t slash = frame.rfind('/');
  if (slash != std::string_view::npos) frame.remove_prefix(slash + 1);
  return frame == "odom" || frame.starts_with("odom_") || frame.ends_with("_odom");
}

/// Some trees hang the map below odom; such a transform is a localizer's answer, not dead reckoning.
bool is_map_frame(std::string_view frame) { return frame.find("map") != std::string_view::npos; }

}  // namespace

Result<RawScan> decode_laser_scan(std::span<const unsigned char> bytes) {
  ByteReader in(bytes);
  RawScan scan;
  Header header = take_header(in);
  scan.stamp = header.stamp;
  scan.frame_id = std::move(header.frame_id);
  scan.angle_min_rad = in.take<float>();
  in.skip(sizeof(float));  // angle_max: often off by one beam; the count of ranges decides
  scan.angle_increment_rad = in.take<float>();
  scan.time_increment_s = in.take<float>();
  scan.scan_time_s = in.take<float>();
  scan.range_min_m = in.take<float>();
  scan.range_max_m = in.take<float>();
  scan.ranges_m = in.floats();
  scan.intensities = in.floats();
  if (!in.at_end()) return ends_early();
  return scan;
}

Result<Odometry> decode_odometry(std::span<const unsigned char> bytes) {
  ByteReader in(bytes);
  Odometry odometry;
  odometry.stamp = take_header(in).stamp;
  in.text();  // child frame
  odometry.odom_from_base = take_pose(in);
  in.skip(kCovarianceBytes);
  Twist2 twist;
  twist.x_m = in.take<double>();
  twist.y_m = in.take<double>();
  in.skip(3 * sizeof(double));
  twist.theta_rad = in.take<double>();
  in.skip(kCovarianceBytes);
  if (!in.at_end()) return ends_early();
  if (!odometry.odom_from_base.is_finite()) return no_pose();
  if (twist.vector().allFinite()) odometry.twist_per_s = twist;
  return odometry;
}

Result<ReferencePose> decode_pose_stamped(std::span<const unsigned char> bytes) {
  return decode_pose(bytes, 0);
}

Result<ReferencePose> decode_pose_with_covariance_stamped(std::span<const unsigned char> bytes) {
  return decode_pose(bytes, kCovarianceBytes);
}

Result<std::vector<Odometry>> decode_odom_transforms(std::span<const unsigned char> bytes) {
  ByteReader in(bytes);
  std::vector<Odometry> found;
  const auto count = in.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    const Header header = take_header(in);
    const std::string child = in.text();
    const Pose2 pose = take_pose(in);
    if (in.ok() && pose.is_finite() && is_odom_frame(header.frame_id) && !is_map_frame(child))
      found.push_back({header.stamp, pose, std::nullopt, header.frame_id + "->" + child});
  }
  if (!in.at_end()) return ends_early();
  return found;
}

}  // namespace beaconless::io
