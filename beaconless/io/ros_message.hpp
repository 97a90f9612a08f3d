// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// One message of a bag, not decoded.
struct RosMessage {
  std::string topic;
  std::string type;     ///< "sensor_msgs/LaserScan" or "sensor_msgs/msg/LaserScan"
  bool is_cdr = false;  ///< serialized as ROS 2 does, not as ROS 1
  std::int64_t recorded_ns = 0;
  std::vector<unsigned char> bytes;
};

/// Messages in the order of their recording, one at a time.
class RosMessageSource {
 public:
  enum class Step { message, broken, end };

  RosMessageSource() = default;
  RosMessageSource(const RosMessageSource&) = delete;
  RosMessageSource& operator=(const RosMessageSource&) = delete;
  virtual ~RosMessageSource() = default;

  /// Fills `message`; of a broken one only topic and time are filled.
  virtual Step next(RosMessage& message) = 0;

  /// Why the messages ended before their time; "" when they did not.
  virtual std::string ended_by() const { return ""; }
};

}  // namespace beaconless::io
