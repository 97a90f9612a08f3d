// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <utility>

#include "beaconless/io/ros_events.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {
namespace {

constexpr std::array kTypes{"sensor_msgs/LaserScan", "nav_msgs/Odometry", "geometry_msgs/PoseStamped",
                            "geometry_msgs/PoseWithCovarianceStamped", "tf2_msgs/TFMessage"};

/// A bag of one message.
class OneMessage : public io::RosMessageSource {
 public:
  explicit OneMessage(io::RosMessage message) : message_(std::move(message)) {}
  Step next(io::RosMessage& message) override {
    if (std::exchange(is_over_, true)) return Step::end;
    message = message_;
    return Step::message;
  }

 private:
  io::RosMessage message_;
  bool is_over_ = false;
};

}  // namespace

void read_messages(Bytes bytes) {
  if (bytes.empty()) return;
  io::RosMessage message;
  message.topic = "/input";
  message.is_cdr = bytes[0] / 8U % 2U == 1;
  message.type = kTypes[bytes[0] % 8U % kTypes.size()];
  message.bytes.assign(bytes.begin() + 1, bytes.end());
  const auto events = io::ros_events("input", std::make_unique<OneMessage>(std::move(message)), {});
  while (const auto event = events->next()) check(*event);
}

}  // namespace beaconless::fuzz
