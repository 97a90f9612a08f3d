// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_bag.hpp"

#include <exception>
#include <utility>

#include <rosbag/bag.h>
#include <rosbag/view.h>

namespace beaconless::io {

struct Rosbag1Bag::Librosbag {
  rosbag::Bag bag;
  rosbag::View view;
  rosbag::View::iterator at;
};

Rosbag1Bag::Rosbag1Bag(const std::string& path, const std::vector<std::string>& topics,
                       std::set<BagMessageKey> broken)
    : broken_(std::move(broken)) {
  try {
    auto librosbag = std::make_unique<Librosbag>();
    librosbag->bag.open(path, rosbag::bagmode::Read);
    librosbag->view.addQuery(librosbag->bag, rosbag::TopicQuery(topics));
    librosbag->at = librosbag->view.begin();
    librosbag_ = std::move(librosbag);
  } catch (const std::exception& error) {
    failure_ = std::string("librosbag says: ") + error.what();
  }
}

Rosbag1Bag::~Rosbag1Bag() = default;

Rosbag1Bag::Step Rosbag1Bag::next(RosMessage& message) {
  if (!librosbag_) return Step::end;
  Step step = Step::broken;
  try {
    if (librosbag_->at == librosbag_->view.end()) return Step::end;
    const rosbag::MessageInstance& instance = *librosbag_->at;
    message.topic = instance.getTopic();
    message.type = instance.getDataType();
    message.recorded_ns = static_cast<std::int64_t>(instance.getTime().toNSec());
    message.bytes.clear();
    if (broken_.count({message.topic, message.recorded_ns}) == 0) {
      message.bytes.resize(instance.size());
      ros::serialization::OStream out(message.bytes.data(), static_cast<std::uint32_t>(message.bytes.size()));
      instance.write(out);
      step = Step::message;
    }
  } catch (const std::exception&) {
    message.bytes.clear();
  }
  try {
    ++librosbag_->at;
  } catch (const std::exception&) {
    librosbag_.reset();
  }
  return step;
}

}  // namespace beaconless::io
