// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// One topic of a bag, counted by its index.
struct BagTopic {
  std::string name;
  std::string type;
  std::uint64_t count = 0;
};

/// Why a bag cannot be read.
struct BagFailure {
  std::uint64_t byte = 0;
  std::string what;
  std::string remedy;
};

/// A message by the name of its topic and the nanosecond of its recording.
using BagMessageKey = std::pair<std::string, std::int64_t>;

/// What a look at a bag found before librosbag touches it.
struct BagSurvey {
  std::optional<BagFailure> failure;
  std::vector<BagTopic> topics;
  std::set<BagMessageKey>
      broken;  ///< messages whose records lie outside their chunk; librosbag must not see them
};

/// Walks through the structure of a ROS 1 bag 2.0 and compares every length with the bytes that are there.
///
/// librosbag believes each length and offset that it meets, in the index as in the chunks, and reads or
/// allocates accordingly; a damaged bag ends the process. What passes here is safe to hand on. Cost: a seek a
/// message in plain chunks, unpacking the compressed ones. Source: wiki.ros.org/Bags/Format/2.0.
BagSurvey survey_rosbag1(const std::string& path);

}  // namespace beaconless::io
