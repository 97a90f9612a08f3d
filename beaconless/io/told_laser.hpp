// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/ros_message.hpp"

namespace beaconless::io {

/// What the fixed transforms of a recording say about its laser.
struct ToldLaser {
  std::optional<LaserPlace> place;
  std::string problem;  ///< why there is none although it is told; else ""
};

/// Opens a pass over the messages of some topics; nothing where that is not possible any more.
using OpenMessages = std::function<std::unique_ptr<RosMessageSource>(const std::vector<std::string>&)>;

/// Where /tf_static says that the laser of `scan_topic` sits; only transforms on a topic of that name (in any
/// namespace) count, also where /tf repeats one that never changes.
///
/// Cost: nothing without such messages; else the source is asked for those that `topics` counts and no more,
/// at most 10,000, for the first scan, and for messages of tf up to the first that moves a base, at most
/// 1000.
ToldLaser told_laser(const OpenMessages& open, std::span<const Topic> topics, const std::string& scan_topic);

}  // namespace beaconless::io
