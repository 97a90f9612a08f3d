// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "beaconless/io/ros_message.hpp"
#include "beaconless/io/rosbag1_survey.hpp"

// Plain C++17: librosbag and what it includes are built as that.
namespace beaconless::io {

/// The messages of some topics of a bag in the order of their recording, one at a time. The one door to
/// librosbag.
class Rosbag1Bag : public RosMessageSource {
 public:
  /// Opens a bag that survey_rosbag1 found sound; what is in `broken` is never touched. Why it cannot be
  /// opened shows in `failure()`, and next() is at the end then.
  Rosbag1Bag(const std::string& path, const std::vector<std::string>& topics, std::set<BagMessageKey> broken);
  ~Rosbag1Bag() override;

  const std::string& failure() const { return failure_; }  ///< "" when the bag is open

  Step next(RosMessage& message) override;

 private:
  struct Librosbag;

  std::string failure_;
  std::set<BagMessageKey> broken_;
  std::unique_ptr<Librosbag> librosbag_;
};

}  // namespace beaconless::io
