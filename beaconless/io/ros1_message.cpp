// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros1_message.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

#include "beaconless/io/byte_reader.hpp"
#include "beaconless/io/ros_layout.hpp"

namespace beaconless::io::ros1 {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are copied as they lie");

/// Packed, without padding.
class Ros1Reader : public ByteReader {
 public:
  using ByteReader::ByteReader;

  template <class T>
  T take() {
    T value{};
    if (const auto bytes = take_bytes(sizeof(T)); !bytes.empty())
      std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  Stamp header_stamp() {
    take<std::uint32_t>();  // seq
    const auto seconds = take<std::uint32_t>();
    const auto nanos = take<std::uint32_t>();
    return {std::int64_t{seconds} * 1'000'000'000 + nanos};
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

  template <class T>
  void skip(std::size_t count) {
    take_bytes(count * sizeof(T));
  }

  bool at_end() const { return ok() && left() == 0; }
};

}  // namespace

Result<RawScan> decode_laser_scan(std::span<const unsigned char> bytes) {
  return ros_layout::take_laser_scan(Ros1Reader(bytes));
}

Result<Odometry> decode_odometry(std::span<const unsigned char> bytes) {
  return ros_layout::take_odometry(Ros1Reader(bytes));
}

Result<ReferencePose> decode_pose_stamped(std::span<const unsigned char> bytes) {
  return ros_layout::take_pose_stamped(Ros1Reader(bytes), 0);
}

Result<ReferencePose> decode_pose_with_covariance_stamped(std::span<const unsigned char> bytes) {
  return ros_layout::take_pose_stamped(Ros1Reader(bytes), ros_layout::kCovariance_count);
}

Result<std::vector<FrameTransform>> decode_transforms(std::span<const unsigned char> bytes) {
  return ros_layout::take_transforms(Ros1Reader(bytes));
}

}  // namespace beaconless::io::ros1
