// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_sink.hpp"

#include <algorithm>

#include "beaconless/io/ros_schemas.hpp"

namespace beaconless::io {

void McapSink::write(const RosMessageOut& message) {
  const auto key = std::pair{std::string(message.topic), std::string(message.type)};
  auto channel = channels_.find(key);
  if (channel == channels_.end()) {
    McapSchema schema{.name = key.second, .encoding = "ros2msg", .text = ros2_schema(key.second)};
    channel = channels_.emplace(key, file_.add_channel(message.topic, "cdr", std::move(schema))).first;
  }
  const auto unsigned_ns = [](std::int64_t ns) {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
  };
  file_.write(channel->second, unsigned_ns(message.recorded_ns), unsigned_ns(message.stamp_ns),
              message.bytes);
}

std::string McapSink::finish() {
  const auto done = file_.finish();
  return done ? "" : done.error().what;
}

}  // namespace beaconless::io
