// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/cdr_message.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "beaconless/io/byte_reader.hpp"
#include "beaconless/io/ros_layout.hpp"

namespace beaconless::io::cdr {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::size_t kMaxPaddingBytes = 3;  // some writers fill the last word

/// Aligned, in the byte order that the header tells.
class CdrReader : public ByteReader {
 public:
  CdrReader(std::span<const unsigned char> body, std::endian order) : ByteReader(body), order_(order) {}

  template <class T>
  T take() {
    align(sizeof(T));
    return number<T>(take_bytes(sizeof(T)));
  }

  Stamp header_stamp() {
    const auto seconds = take<std::int32_t>();
    const auto nanos = take<std::uint32_t>();
    return {std::int64_t{seconds} * 1'000'000'000 + nanos};
  }

  std::string text() {  // its length counts the closing zero
    const auto bytes = take_bytes(take<std::uint32_t>());
    return {bytes.begin(), std::find(bytes.begin(), bytes.end(), '\0')};
  }

  std::vector<float> floats() {
    const auto bytes = take_bytes(std::uint64_t{take<std::uint32_t>()} * sizeof(float));
    std::vector<float> values;
    values.reserve(bytes.size() / sizeof(float));
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float))
      values.push_back(number<float>(bytes.subspan(at, sizeof(float))));
    return values;
  }

  template <class T>
  void skip(std::size_t count) {
    if (count == 0) return;
    align(sizeof(T));
    take_bytes(count * sizeof(T));
  }

  bool at_end() const { return ok() && left() <= kMaxPaddingBytes; }

 private:
  void align(std::size_t size) { take_bytes((size - taken() % size) % size); }

  template <class T>
  T number(std::span<const unsigned char> bytes) const {
    if (bytes.empty()) return T{};
    std::array<unsigned char, sizeof(T)> raw{};
    std::copy(bytes.begin(), bytes.end(), raw.begin());
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }

  std::endian order_;
};

/// Reads the header, and the body with `take`.
template <class Take>
auto decode(std::span<const unsigned char> bytes, Take take)
    -> decltype(take(CdrReader(bytes, std::endian::little))) {
  if (bytes.size() < kHeaderBytes) return ros_layout::ends_early();
  if (bytes[0] != 0 || bytes[1] > 1)
    return Error{"",
                 "the message is not plain CDR (its header says " + std::to_string(bytes[0]) + " " +
                     std::to_string(bytes[1]) + ")",
                 ""};
  const auto order = bytes[1] == 1 ? std::endian::little : std::endian::big;
  return take(CdrReader(bytes.subspan(kHeaderBytes), order));
}

}  // namespace

Result<RawScan> decode_laser_scan(std::span<const unsigned char> bytes) {
  return decode(bytes, [](CdrReader in) { return ros_layout::take_laser_scan(in); });
}

Result<Odometry> decode_odometry(std::span<const unsigned char> bytes) {
  return decode(bytes, [](CdrReader in) { return ros_layout::take_odometry(in); });
}

Result<ReferencePose> decode_pose_stamped(std::span<const unsigned char> bytes) {
  return decode(bytes, [](CdrReader in) { return ros_layout::take_pose_stamped(in, 0); });
}

Result<ReferencePose> decode_pose_with_covariance_stamped(std::span<const unsigned char> bytes) {
  return decode(
      bytes, [](CdrReader in) { return ros_layout::take_pose_stamped(in, ros_layout::kCovariance_count); });
}

Result<std::vector<FrameTransform>> decode_transforms(std::span<const unsigned char> bytes) {
  return decode(bytes, [](CdrReader in) { return ros_layout::take_transforms(in); });
}

}  // namespace beaconless::io::cdr
