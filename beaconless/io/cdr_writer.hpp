// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "beaconless/core/stamp.hpp"
#include "beaconless/io/byte_writer.hpp"
#include "beaconless/io/ros_layout_out.hpp"

namespace beaconless::io {

/// Puts the fields of a ROS 2 message as they lie on the wire: XCDR version 1, little-endian, each number at
/// a multiple of its own size counted from behind the four bytes that tell the encoding.
///
/// Source: OMG CORBA 3.4 part 2, 9.3; DDS-RTPS 2.3, 10.
class CdrWriter {
 public:
  CdrWriter() { out_.assign("\0\1\0\0", kHeaderBytes); }

  template <class T>
  void put(T value) {
    const std::size_t past = (out_.size() - kHeaderBytes) % sizeof(T);
    if (past != 0) out_.append(sizeof(T) - past, '\0');
    ByteWriter(out_).put(value);
  }

  /// What a Header holds before its frame.
  void header_stamp(Stamp stamp) {
    using Seconds = std::numeric_limits<std::int32_t>;
    const auto [seconds, nanos] = whole_seconds(stamp);
    put(static_cast<std::int32_t>(std::clamp<std::int64_t>(seconds, Seconds::min(), Seconds::max())));
    put(nanos);
  }

  /// Behind its length, which counts the zero at its end.
  void text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    out_.append(text).push_back('\0');
  }

  void floats(std::span<const float> values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const float value : values) put(value);
  }

  std::string take() { return std::move(out_); }

 private:
  static constexpr std::size_t kHeaderBytes = 4;
  std::string out_;
};

}  // namespace beaconless::io
