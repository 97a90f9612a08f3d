// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// One message on its way into a file; what it points to lives as long as the call.
struct RosMessageOut {
  std::string_view topic;
  std::string_view type;         ///< as the file's ROS writes it
  std::int64_t recorded_ns = 0;  ///< never less than that of the message before
  std::int64_t stamp_ns = 0;     ///< of its header
  bool is_latched = false;       ///< kept for those who come late: ROS 2 says transient local
  std::string_view bytes;
};

/// Takes messages one at a time into a file of some format; the twin of RosMessageSource.
class RosMessageSink {
 public:
  RosMessageSink() = default;
  RosMessageSink(const RosMessageSink&) = delete;
  RosMessageSink& operator=(const RosMessageSink&) = delete;
  virtual ~RosMessageSink() = default;

  virtual void write(const RosMessageOut& message) = 0;
  virtual bool good() const = 0;

  /// Writes what is left and closes the file; "", or why not all of it has reached the file.
  virtual std::string finish() = 0;
};

}  // namespace beaconless::io
