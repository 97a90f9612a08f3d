// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros_events.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <utility>

#include "beaconless/io/cdr_message.hpp"
#include "beaconless/io/ros1_message.hpp"
#include "beaconless/io/stamp_order.hpp"

namespace beaconless::io {
namespace {

constexpr std::string_view kOdometry = "nav_msgs/Odometry";
constexpr std::string_view kPose = "geometry_msgs/PoseStamped";
constexpr std::string_view kPoseWithCovariance = "geometry_msgs/PoseWithCovarianceStamped";

class RosEvents : public EventStream {
 public:
  RosEvents(std::string path, std::unique_ptr<RosMessageSource> source, RecordingOptions options)
      : path_(std::move(path)), source_(std::move(source)), options_(std::move(options)) {}

  std::optional<Event> next() override {
    for (;;) {
      if (!waiting_.empty()) {
        Event event = std::move(waiting_.front());
        waiting_.pop_front();
        return event;
      }
      const auto step = source_->next(message_);
      if (step == RosMessageSource::Step::end) break;
      if (step == RosMessageSource::Step::broken) {
        skip("the record is damaged");
      } else if (auto event = decode()) {
        return event;
      }
    }
    if (const std::string why = source_->ended_by(); !why.empty() && !is_end_told_ && options_.on_problem)
      options_.on_problem({path_, why});
    is_end_told_ = true;
    order_.report_once(options_.on_problem);
    return std::nullopt;
  }

  std::uint64_t skipped() const override { return skipped_; }

 private:
  std::optional<Event> decode() {
    const std::span<const unsigned char> bytes(message_.bytes);
    const bool is_cdr = message_.is_cdr;
    const std::string type = short_type(message_.type);
    if (is_laser_scan_type(type))
      return read_scan(is_cdr ? cdr::decode_laser_scan(bytes) : ros1::decode_laser_scan(bytes));
    if (type == kOdometry) return named(is_cdr ? cdr::decode_odometry(bytes) : ros1::decode_odometry(bytes));
    if (type == kPose)
      return named(is_cdr ? cdr::decode_pose_stamped(bytes) : ros1::decode_pose_stamped(bytes));
    if (type == kPoseWithCovariance)
      return named(is_cdr ? cdr::decode_pose_with_covariance_stamped(bytes)
                          : ros1::decode_pose_with_covariance_stamped(bytes));
    return is_transforms_type(type) ? read_transforms() : std::nullopt;
  }

  std::optional<Event> read_transforms() {
    const auto transforms = transforms_of(message_);
    if (!transforms) return skip(transforms.error().what);
    for (Odometry& odometry : odometry_of(*transforms)) {
      odometry.source = message_.topic + " " + odometry.source;
      waiting_.emplace_back(std::move(odometry));
    }
    return std::nullopt;
  }

  std::optional<Event> read_scan(Result<RawScan> raw) {
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
  std::unique_ptr<RosMessageSource> source_;
  RecordingOptions options_;
  RosMessage message_;
  std::deque<Event> waiting_;  ///< one message of tf can hold several transforms
  StampOrder order_;
  std::uint64_t skipped_ = 0;
  bool is_end_told_ = false;
};

}  // namespace

std::string short_type(std::string_view type) {
  std::string name(type);
  if (const std::size_t at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
  return name;
}

bool is_laser_scan_type(std::string_view type) { return short_type(type) == "sensor_msgs/LaserScan"; }

bool is_transforms_type(std::string_view type) {
  const std::string name = short_type(type);
  return name == "tf/tfMessage" || name == "tf2_msgs/TFMessage";
}

bool is_pose_type(std::string_view type) {
  const std::array types{kOdometry, kPose, kPoseWithCovariance};
  return is_transforms_type(type) || std::find(types.begin(), types.end(), short_type(type)) != types.end();
}

Result<std::vector<FrameTransform>> transforms_of(const RosMessage& message) {
  return message.is_cdr ? cdr::decode_transforms(message.bytes) : ros1::decode_transforms(message.bytes);
}

std::unique_ptr<EventStream> ros_events(std::string path, std::unique_ptr<RosMessageSource> source,
                                        RecordingOptions options) {
  return std::make_unique<RosEvents>(std::move(path), std::move(source), std::move(options));
}

}  // namespace beaconless::io
