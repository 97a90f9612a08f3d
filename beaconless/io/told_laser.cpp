// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/told_laser.hpp"

#include <algorithm>
#include <cstdint>

#include "beaconless/io/cdr_message.hpp"
#include "beaconless/io/laser_place.hpp"
#include "beaconless/io/ros1_message.hpp"
#include "beaconless/io/ros_events.hpp"

namespace beaconless::io {
namespace {

constexpr std::uint64_t kMostFixed = 10'000;
constexpr std::uint64_t kMostLooked = 1000;

/// Calls `use` for the first messages of some topics, until it says that this was enough.
template <class Use>
void look_at(const OpenMessages& open, const std::vector<std::string>& topics, std::uint64_t most, Use use) {
  if (topics.empty()) return;
  const auto messages = open(topics);
  RosMessage message;
  for (std::uint64_t i = 0; messages && i < most; ++i) {
    const auto step = messages->next(message);
    if (step == RosMessageSource::Step::end) return;
    if (step == RosMessageSource::Step::message && use(message)) return;
  }
}

}  // namespace

ToldLaser told_laser(const OpenMessages& open, std::span<const Topic> topics, const std::string& scan_topic) {
  std::vector<std::string> fixed_topics;
  std::vector<std::string> moving_topics;
  std::uint64_t fixed_count = 0;
  for (const Topic& topic : topics) {
    if (!is_transforms_type(topic.type) || topic.count == 0) continue;
    const bool is_fixed = topic.name.ends_with("tf_static");
    (is_fixed ? fixed_topics : moving_topics).push_back(topic.name);
    if (is_fixed) fixed_count += topic.count;
  }
  std::vector<FrameTransform> fixed;
  look_at(open, fixed_topics, std::min(fixed_count, kMostFixed), [&](const RosMessage& message) {
    if (auto transforms = transforms_of(message))
      fixed.insert(fixed.end(), transforms.value().begin(), transforms.value().end());
    return false;
  });
  if (fixed.empty() || scan_topic.empty()) return {};
  std::string laser_frame;
  look_at(open, {scan_topic}, kMostLooked, [&](const RosMessage& message) {
    const auto scan =
        message.is_cdr ? cdr::decode_laser_scan(message.bytes) : ros1::decode_laser_scan(message.bytes);
    if (scan) laser_frame = scan->frame_id;
    return scan.ok();
  });
  std::vector<std::string> bases;  // odometry moves the base; without it the usual names
  look_at(open, moving_topics, kMostLooked, [&](const RosMessage& message) {
    const auto transforms = transforms_of(message);
    if (!transforms) return false;
    for (const FrameTransform& transform : *transforms)
      if (is_odom_transform(transform)) bases.push_back(transform.child);
    return !bases.empty();
  });
  bases.insert(bases.end(), {"base_link", "base_footprint"});
  auto place = laser_place(fixed, laser_frame, bases);
  if (!place) return {std::nullopt, to_string(place.error())};
  if (*place) place.value()->told_by = fixed_topics.front() + ", " + place.value()->told_by;
  return {*place, ""};
}

}  // namespace beaconless::io
