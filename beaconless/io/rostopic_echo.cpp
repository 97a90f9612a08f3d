// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rostopic_echo.hpp"

#include <cmath>
#include <utility>

#include "beaconless/io/echo_document.hpp"
#include "beaconless/io/failed_pass.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/line_reader.hpp"
#include "beaconless/io/stamp_order.hpp"
#include "beaconless/io/topic_choice.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr const char* kScan = "scan";
constexpr const char* kOdometry = "odometry";
constexpr const char* kPose = "pose";
constexpr const char* kCut = "the text ends before the message does";

/// Fills `document` with the next message of the text; false at the end.
bool take_document(LineReader& lines, EchoDocument& document, bool& is_delimited) {
  document.clear();
  is_delimited = false;
  while (const auto line = lines.next()) {
    if (line->starts_with(EchoDocument::kDelimiter)) {
      is_delimited = true;
      return true;
    }
    document.take(*line);
  }
  return document.kind() != EchoKind::nothing;
}

class EchoStream : public EventStream {
 public:
  EchoStream(LineReader lines, RecordingOptions options)
      : lines_(std::move(lines)), options_(std::move(options)) {}

  std::optional<Event> next() override {
    bool is_delimited = false;
    while (take_document(lines_, document_, is_delimited))
      if (auto event = read(is_delimited)) return event;
    order_.report_once(options_.on_problem);
    return std::nullopt;
  }

  std::uint64_t skipped() const override { return skipped_; }

 private:
  std::optional<Event> read(bool is_delimited) {
    switch (document_.kind()) {
      case EchoKind::scan:
        return read_scan(is_delimited);
      case EchoKind::odometry:
        return is_delimited ? event_of(document_.odometry()) : skip(kCut);
      case EchoKind::pose:
        return is_delimited ? event_of(document_.pose()) : skip(kCut);
      default:
        return std::nullopt;
    }
  }

  std::optional<Event> read_scan(bool is_delimited) {
    if (!is_delimited && !document_.is_whole()) return skip(kCut);
    auto raw = document_.scan();
    if (!raw) return skip(raw.error().what);
    const Stamp stamp = raw->stamp;
    auto scan = Scan::make(std::move(raw).value(), options_.gate);
    if (!scan) return skip(scan.error().what);
    order_.see(stamp, lines_.where());
    return Event(std::move(scan).value());
  }

  template <class T>
  std::optional<Event> event_of(const Result<T>& message) {
    return message ? std::optional<Event>(*message) : skip(message.error().what);
  }

  std::optional<Event> skip(const std::string& what) {
    ++skipped_;
    if (options_.on_problem) options_.on_problem({lines_.where(), what + "; the message is passed over"});
    return std::nullopt;
  }

  LineReader lines_;
  RecordingOptions options_;
  EchoDocument document_;
  StampOrder order_;
  std::uint64_t skipped_ = 0;
};

Error abridged(const std::string& where, bool is_ros2) {
  return {where,
          is_ros2 ? "the scan's arrays were cut short when it was echoed: ROS 2 prints no more than 128 "
                    "values of each"
                  : "the scan's arrays were left out when it was echoed",
          is_ros2 ? "record it again with `ros2 topic echo --full-length TOPIC`, without --no-arr"
                  : "record it again with `rostopic echo TOPIC`, without --noarr"};
}

/// A float as Python prints the double it widens to.
std::string python_text(float value) {
  std::string text;
  append_number(text, static_cast<double>(value));
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return std::isnan(value) ? "nan" : text;
}

std::string python_list(std::span<const float> values) {
  std::string text = "[";
  for (const float value : values) text += (text.size() > 1 ? ", " : "") + python_text(value);
  return text + "]";
}

}  // namespace

Result<Recording> open_rostopic_echo(const std::string& path, const RecordingOptions& options) {
  auto lines = LineReader::open(path);
  if (!lines) return lines.error();
  Topic scans{kScan, "sensor_msgs/LaserScan", 0};
  Topic odometry{kOdometry, "nav_msgs/Odometry", 0};
  Topic poses{kPose, "geometry_msgs/PoseStamped", 0};
  EchoDocument document;
  bool is_delimited = false;
  while (take_document(lines.value(), document, is_delimited)) {
    if (document.kind() == EchoKind::scan && scans.count == 0 && document.is_abridged())
      return abridged(lines->where(), document.is_ros2());
    scans.count += document.kind() == EchoKind::scan ? 1 : 0;
    odometry.count += document.kind() == EchoKind::odometry ? 1 : 0;
    poses.count += document.kind() == EchoKind::pose ? 1 : 0;
  }
  std::vector<Topic> topics;
  for (const Topic& topic : {scans, odometry, poses})
    if (topic.count > 0) topics.push_back(topic);
  const auto chosen = choose_scan_topic(path, options, std::span(topics).first(scans.count > 0 ? 1 : 0));
  if (!chosen) return chosen.error();
  return Recording(path, "rostopic echo", *chosen, std::move(topics),
                   [path, options]() -> std::unique_ptr<EventStream> {
                     auto opened = LineReader::open(path, options.on_problem);
                     if (!opened) return failed_pass(opened.error(), options.on_problem);
                     return std::make_unique<EchoStream>(std::move(opened).value(), options);
                   });
}

std::string to_rostopic_echo(const RawScan& scan) {
  constexpr std::int64_t kNanos = 1'000'000'000;
  std::int64_t seconds = scan.stamp.ns / kNanos;
  if (seconds * kNanos > scan.stamp.ns) --seconds;  // nsecs count up from secs, before 1970 too
  std::string nanos = std::to_string(scan.stamp.ns - seconds * kNanos);
  nanos.insert(0, 9 - nanos.size(), ' ');  // right-aligned, as ROS 1 prints it
  const auto steps = static_cast<float>(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1);
  std::string text =
      "header: \n  seq: 0\n  stamp: \n    secs: " + std::to_string(seconds) + "\n    nsecs: " + nanos;
  text += "\n  frame_id: \"" + scan.frame_id + "\"\n";
  text += "angle_min: " + python_text(scan.angle_min_rad) + "\n";
  text += "angle_max: " + python_text(scan.angle_min_rad + steps * scan.angle_increment_rad) + "\n";
  text += "angle_increment: " + python_text(scan.angle_increment_rad) + "\n";
  text += "time_increment: " + python_text(scan.time_increment_s) + "\n";
  text += "scan_time: " + python_text(scan.scan_time_s) + "\n";
  text += "range_min: " + python_text(scan.range_min_m) + "\n";
  text += "range_max: " + python_text(scan.range_max_m) + "\n";
  text += "ranges: " + python_list(scan.ranges_m) + "\n";
  text += "intensities: " + python_list(scan.intensities) + "\n";
  return text + EchoDocument::kDelimiter + "\n";
}

Result<Done> write_rostopic_echo(const std::string& path, std::span<const RawScan> scans) {
  std::string text;
  for (const RawScan& scan : scans) text += to_rostopic_echo(scan);
  return write_whole_file(path, text);
}

}  // namespace beaconless::io
