// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "beaconless/io/ros_message_sink.hpp"

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// What ROS 1 has to know about a message type; the MD5 sum is empty where nobody knows it.
struct Rosbag1Type {
  std::string md5;
  std::string definition;
};

/// How the chunks of a ROS 1 bag are packed.
enum class Rosbag1Compression { none, lz4, bz2 };

/// Writes ROS 1 messages into a bag 2.0, by librosbag.
///
/// A bag that was not finished has no index, so write it under another name (PartFile). Times of recording
/// are made to differ by a nanosecond at least, because librosbag's readers order messages by them alone.
class Rosbag1Writer : public RosMessageSink {
 public:
  using TypeOf = std::function<Rosbag1Type(const std::string& type)>;

  /// Writes over what is there. A path that cannot be written shows in `good()`.
  Rosbag1Writer(const std::string& path, Rosbag1Compression compression, TypeOf type_of);
  ~Rosbag1Writer() override;

  void write(const RosMessageOut& message) override;
  bool good() const override { return why_.empty(); }
  std::string finish() override;

 private:
  struct Librosbag;

  void fail(const char* says);

  TypeOf type_of_;
  std::string why_;  ///< nothing more is written
  std::unique_ptr<Librosbag> librosbag_;
  std::int64_t last_ns_ = 0;
};

}  // namespace beaconless::io
