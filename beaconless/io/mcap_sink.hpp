// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "beaconless/io/mcap_writer.hpp"
#include "beaconless/io/ros_message_sink.hpp"

namespace beaconless::io {

/// Writes ROS 2 messages into an MCAP file, with the schemas of those that cdr_encode.hpp makes.
class McapSink : public RosMessageSink {
 public:
  /// A path that cannot be written shows in `good()`.
  explicit McapSink(const std::string& path, const McapLayout& layout = {}) : file_(path, "ros2", layout) {}

  void write(const RosMessageOut& message) override;
  bool good() const override { return file_.good(); }
  std::string finish() override;

 private:
  McapWriter file_;
  std::map<std::pair<std::string, std::string>, std::uint16_t> channels_;  ///< by topic and type
};

}  // namespace beaconless::io
