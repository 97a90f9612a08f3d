// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros1_encode.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "beaconless/io/byte_writer.hpp"
#include "beaconless/io/ros_layout_out.hpp"

namespace beaconless::io::ros1 {
namespace {

/// Packed, without padding.
class Ros1Writer {
 public:
  template <class T>
  void put(T value) {
    ByteWriter(out_).put(value);
  }

  void header_stamp(Stamp stamp) {
    constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
    const auto [seconds, nanos] = whole_seconds(stamp);
    put(std::uint32_t{0});  // seq
    put(static_cast<std::uint32_t>(seconds < 0 ? 0 : seconds > kMost ? kMost : seconds));
    put(seconds < 0 ? std::uint32_t{0} : nanos);
  }

  void text(std::string_view text) { ByteWriter(out_).text(text); }

  void floats(std::span<const float> values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const float value : values) put(value);
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

}  // namespace

std::string encode_laser_scan(const RawScan& scan) { return ros_layout::put_laser_scan(Ros1Writer(), scan); }

std::string encode_odometry(const Odometry& odometry, std::string_view frame, std::string_view child_frame) {
  return ros_layout::put_odometry(Ros1Writer(), odometry, frame, child_frame);
}

std::string encode_pose_stamped(Stamp stamp, std::string_view frame, const Pose2& pose) {
  return ros_layout::put_pose_stamped(Ros1Writer(), stamp, frame, pose);
}

std::string encode_transform(Stamp stamp, std::string_view frame, std::string_view child_frame,
                             const Pose2& frame_from_child) {
  return ros_layout::put_transform(Ros1Writer(), stamp, frame, child_frame, frame_from_child);
}

}  // namespace beaconless::io::ros1
