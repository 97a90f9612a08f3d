// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_recording.hpp"

#ifndef BEACONLESS_HAS_ROSBAG1

namespace beaconless::io {

Result<Recording> open_rosbag1(const std::string& path, const RecordingOptions&) {
  return Error{path, "is a ROS 1 bag, and this program was built without reading them",
               "install librosbag-storage-dev and build again"};
}

}  // namespace beaconless::io

#else

#include <algorithm>
#include <array>
#include <deque>
#include <fstream>
#include <memory>
#include <utility>

#include "beaconless/io/failed_pass.hpp"
#include "beaconless/io/ros1_message.hpp"
#include "beaconless/io/rosbag1_bag.hpp"
#include "beaconless/io/stamp_order.hpp"
#include "beaconless/io/topic_choice.hpp"

namespace beaconless::io {
namespace {

constexpr const char* kLaserScan = "sensor_msgs/LaserScan";
constexpr std::array kOtherTypes{"nav_msgs/Odometry", "geometry_msgs/PoseStamped",
                                 "geometry_msgs/PoseWithCovarianceStamped", "tf/tfMessage",
                                 "tf2_msgs/TFMessage"};

class BagStream : public EventStream {
 public:
  BagStream(std::string path, std::unique_ptr<Rosbag1Bag> bag, RecordingOptions options)
      : path_(std::move(path)), bag_(std::move(bag)), options_(std::move(options)) {}

  std::optional<Event> next() override {
    for (;;) {
      if (!waiting_.empty()) {
        Event event = std::move(waiting_.front());
        waiting_.pop_front();
        return event;
      }
      const auto step = bag_->next(message_);
      if (step == Rosbag1Bag::Step::end) break;
      if (step == Rosbag1Bag::Step::broken) {
        skip("the record is damaged");
      } else if (auto event = decode()) {
        return event;
      }
    }
    order_.report_once(options_.on_problem);
    return std::nullopt;
  }

  std::uint64_t skipped() const override { return skipped_; }

 private:
  std::optional<Event> decode() {
    const std::span<const unsigned char> bytes(message_.bytes);
    if (message_.type == kLaserScan) return read_scan(bytes);
    if (message_.type == "nav_msgs/Odometry") return named(decode_odometry(bytes));
    if (message_.type == "geometry_msgs/PoseStamped") return named(decode_pose_stamped(bytes));
    if (message_.type == "geometry_msgs/PoseWithCovarianceStamped")
      return named(decode_pose_with_covariance_stamped(bytes));
    auto transforms = decode_odom_transforms(bytes);
    if (!transforms) return skip(transforms.error().what);
    for (Odometry& transform : transforms.value()) {
      transform.source = message_.topic + " " + transform.source;
      waiting_.emplace_back(std::move(transform));
    }
    return std::nullopt;
  }

  std::optional<Event> read_scan(std::span<const unsigned char> bytes) {
    auto raw = decode_laser_scan(bytes);
    if (!raw) return skip(raw.error().what);
    const Stamp stamp = raw->stamp;
    auto scan = Scan::make(std::move(raw).value(), options_.gate);
    if (!scan) return skip(scan.error().what);
    order_.see(stamp, where());
    return Event(std::move(scan).value());
  }

  template <class T>
  std::optional<Event> named(Result<T> message) {
    if (!message) return skip(message.error().what);
    message.value().source = message_.topic;
    return Event(std::move(message).value());
  }

  std::string where() const {
    return path_ + " " + message_.topic + " recorded at " + to_string(Stamp{message_.recorded_ns});
  }

  std::optional<Event> skip(const std::string& what) {
    ++skipped_;
    if (options_.on_problem) options_.on_problem({where(), what + "; the message is passed over"});
    return std::nullopt;
  }

  std::string path_;
  std::unique_ptr<Rosbag1Bag> bag_;
  RecordingOptions options_;
  BagMessage message_;
  std::deque<Event> waiting_;  ///< one message of tf can hold several transforms
  StampOrder order_;
  std::uint64_t skipped_ = 0;
};

/// Formats other than 2.0 by the name that they give themselves in their first line.
std::optional<Error> refuse_version(const std::string& path) {
  std::string version(32, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(version.data(), static_cast<std::streamsize>(version.size()));
  version.resize(static_cast<std::size_t>(in.gcount()));
  version.resize(std::min(version.find('\n'), version.size()));
  if (version == "#ROSBAG V2.0") return std::nullopt;
  std::string name;
  for (const char c : version) name += c >= ' ' && c <= '~' ? c : '?';
  return Error{path, "is a bag of the format '" + name + "'; only '#ROSBAG V2.0' is read",
               "bring a copy up to date with `rosbag fix old.bag new.bag`"};
}

bool is_used(const Topic& topic) {
  return std::find(kOtherTypes.begin(), kOtherTypes.end(), topic.type) != kOtherTypes.end();
}

}  // namespace

Result<Recording> open_rosbag1(const std::string& path, const RecordingOptions& options) {
  if (auto error = refuse_version(path)) return *error;
  BagSurvey survey = survey_rosbag1(path);
  if (survey.failure)
    return Error{path + "@" + std::to_string(survey.failure->byte), survey.failure->what,
                 survey.failure->remedy};
  std::vector<Topic> topics;
  std::vector<Topic> scan_topics;
  std::vector<std::string> read_topics;
  for (const BagTopic& topic : survey.topics) {
    topics.push_back({topic.name, topic.type, topic.count});
    if (topic.type == kLaserScan) scan_topics.push_back(topics.back());
    if (is_used(topics.back())) read_topics.push_back(topic.name);
  }
  const auto chosen = choose_scan_topic(path, options, scan_topics);
  if (!chosen) return chosen.error();
  if (!chosen->empty()) read_topics.push_back(*chosen);
  const auto open_bag = [path, read_topics, broken = std::move(survey.broken)] {
    return std::make_unique<Rosbag1Bag>(path, read_topics, broken);
  };
  if (const auto tried = open_bag(); !tried->failure().empty()) return Error{path, tried->failure(), ""};
  return Recording(path, "ROS 1 bag 2.0", *chosen, std::move(topics),
                   [path, open_bag, options]() -> std::unique_ptr<EventStream> {
                     auto bag = open_bag();
                     if (!bag->failure().empty())
                       return failed_pass(Error{path, bag->failure(), ""}, options.on_problem);
                     return std::make_unique<BagStream>(path, std::move(bag), options);
                   });
}

}  // namespace beaconless::io

#endif
