// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "beaconless/io/rosbag1_survey.hpp"

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// One message of a bag, not decoded.
struct BagMessage {
  std::string topic;
  std::string type;  ///< "sensor_msgs/LaserScan"
  std::int64_t recorded_ns = 0;
  std::vector<unsigned char> bytes;
};

/// The messages of some topics of a bag in the order of their recording, one at a time. The one door to
/// librosbag.
class Rosbag1Bag {
 public:
  enum class Step { message, broken, end };

  /// Opens a bag that survey_rosbag1 found sound; what is in `broken` is never touched. Why it cannot be
  /// opened shows in `failure()`, and next() is at the end then.
  Rosbag1Bag(const std::string& path, const std::vector<std::string>& topics, std::set<BagMessageKey> broken);
  Rosbag1Bag(const Rosbag1Bag&) = delete;
  Rosbag1Bag& operator=(const Rosbag1Bag&) = delete;
  ~Rosbag1Bag();

  const std::string& failure() const { return failure_; }  ///< "" when the bag is open

  /// Fills `message`; of a broken one only topic and time are filled.
  Step next(BagMessage& message);

 private:
  struct Librosbag;

  std::string failure_;
  std::set<BagMessageKey> broken_;
  std::unique_ptr<Librosbag> librosbag_;
};

}  // namespace beaconless::io
