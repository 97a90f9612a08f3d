// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/echo_document.hpp"

#include <cmath>
#include <cstdint>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/quaternion_yaw.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxScalars = 1000;
constexpr std::size_t kMaxScalarBytes = 4096;

Error bad(std::string what) { return Error{"", std::move(what), ""}; }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t start = text.find_first_not_of(kBlank);
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(kBlank) - start + 1);
}

std::string_view unquoted(std::string_view text) {
  const bool quoted =
      text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// YAML writes `.nan` and `.inf` where Python writes `nan` and `inf`.
std::optional<float> parse_item(std::string_view item) {
  if (item == ".nan") return std::nanf("");
  if (item == ".inf") return HUGE_VALF;
  if (item == "-.inf") return -HUGE_VALF;
  return parse_float(item);
}

}  // namespace

void EchoDocument::take(std::string_view line) {
  const std::string_view content = trimmed(line);
  if (content.empty() || content.front() == '#') return;
  any_ = true;
  if (open_bracket_ != Array::none) return take_items(content);
  if (content.starts_with("- ")) {
    if (open_list_ != Array::none) take_item(open_list_, trimmed(content.substr(2)));
    return;  // items of other lists, a covariance or the transforms of tf, are none of ours
  }
  open_list_ = Array::none;
  const std::size_t colon = content.find(':');
  if (colon == std::string_view::npos) return;
  const std::string name = full_name(line.find_first_not_of(" \t"), content.substr(0, colon));
  take_value(name, trimmed(content.substr(colon + 1)));
}

std::string EchoDocument::full_name(std::size_t indent, std::string_view key) {
  while (!levels_.empty() && levels_.back().indent >= indent) levels_.pop_back();
  if (levels_.size() < kMaxDepth) levels_.push_back({indent, std::string(key.substr(0, kMaxScalarBytes))});
  std::string name;
  for (const Level& level : levels_) name += (name.empty() ? "" : ".") + level.name;
  return name;
}

void EchoDocument::take_value(const std::string& name, std::string_view value) {
  const Array array = name == "ranges"        ? Array::ranges
                      : name == "intensities" ? Array::intensities
                                              : Array::none;
  has_ranges_ = has_ranges_ || array == Array::ranges;
  if (array == Array::none) {
    if (!value.empty() && scalars_.size() < kMaxScalars)
      scalars_[name] = unquoted(value.substr(0, kMaxScalarBytes));
  } else if (value.empty()) {
    open_list_ = array;
  } else if (value.front() == '[') {
    open_bracket_ = array;
    take_items(value.substr(1));
  } else if (value.find("type: float") != std::string_view::npos) {
    abridged_ = true;  // "<array type: float32, length: 1081>"
  } else {
    fault_ = name + " are '" + shown(value) + "'";
  }
}

void EchoDocument::take_items(std::string_view items) {
  const std::size_t end = items.find(']');
  const bool closes = end != std::string_view::npos;
  items = items.substr(0, end);
  while (!items.empty()) {
    const std::size_t comma = items.find(',');
    if (const auto item = trimmed(items.substr(0, comma)); !item.empty()) take_item(open_bracket_, item);
    items.remove_prefix(comma == std::string_view::npos ? items.size() : comma + 1);
  }
  if (!closes) return;
  whole_ = whole_ || open_bracket_ == Array::intensities;
  open_bracket_ = Array::none;
}

void EchoDocument::take_item(Array array, std::string_view item) {
  std::vector<float>& values = array == Array::ranges ? ranges_ : intensities_;
  if (unquoted(item) == "...") {
    abridged_ = true;
  } else if (const auto value = parse_item(item); !value) {
    fault_ = "an array holds '" + shown(item) + "', not a number";
  } else if (values.size() > Scan::kMaxBeams) {
    fault_ = "an array holds more numbers than any scanner has beams";
  } else {
    values.push_back(*value);
  }
}

EchoKind EchoDocument::kind() const {
  if (!any_) return EchoKind::nothing;
  if (has_ranges_) return EchoKind::scan;
  if (scalars_.contains("pose.pose.position.x"))
    return scalars_.contains("child_frame_id") ? EchoKind::odometry : EchoKind::pose;
  return scalars_.contains("pose.position.x") ? EchoKind::pose : EchoKind::other;
}

Result<double> EchoDocument::number(const std::string& name) const {
  const auto found = scalars_.find(name);
  if (found == scalars_.end()) return bad("has no " + name);
  if (const auto value = parse_item(found->second); value && !std::isfinite(*value))
    return static_cast<double>(*value);
  if (const auto value = parse_double(found->second)) return *value;
  return bad(name + " is '" + shown(found->second) + "', not a number");
}

Result<Stamp> EchoDocument::stamp() const {
  constexpr std::int64_t kNanos = 1'000'000'000;
  const auto part = [&](const char* ros1, const char* ros2) -> std::optional<std::int64_t> {
    auto found = scalars_.find(ros1);
    if (found == scalars_.end()) found = scalars_.find(ros2);
    return found == scalars_.end() ? std::nullopt : parse_int<std::int64_t>(found->second);
  };
  const auto seconds = part("header.stamp.secs", "header.stamp.sec");
  const auto nanos = part("header.stamp.nsecs", "header.stamp.nanosec");
  if (!seconds || !nanos || *nanos < 0 || *nanos >= kNanos || *seconds > 9'000'000'000 ||
      *seconds < -9'000'000'000)
    return bad("has no usable header.stamp");
  return Stamp{*seconds * kNanos + *nanos};
}

Result<Pose2> EchoDocument::planar_pose(const std::string& prefix) const {
  double values[6] = {};
  constexpr const char* kNames[] = {"position.x",    "position.y",    "orientation.x",
                                    "orientation.y", "orientation.z", "orientation.w"};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = number(prefix + kNames[i]);
    if (!value) return value.error();
    values[i] = *value;
  }
  const auto yaw = yaw_rad_of_quaternion(values[2], values[3], values[4], values[5]);
  if (!yaw || !std::isfinite(values[0]) || !std::isfinite(values[1]))
    return bad("the pose is no pose in the plane");
  return Pose2{values[0], values[1], *yaw};
}

Result<RawScan> EchoDocument::scan() const {
  if (!fault_.empty()) return bad(fault_);
  if (abridged_) return bad("its arrays are abridged");
  if (open_bracket_ != Array::none) return bad("an array is not closed: the text ends early");
  RawScan raw;
  const auto when = stamp();
  if (!when) return when.error();
  raw.stamp = *when;
  if (const auto frame = scalars_.find("header.frame_id"); frame != scalars_.end())
    raw.frame_id = frame->second;
  const std::pair<const char*, float*> fields[] = {
      {"angle_min", &raw.angle_min_rad},         {"angle_increment", &raw.angle_increment_rad},
      {"time_increment", &raw.time_increment_s}, {"scan_time", &raw.scan_time_s},
      {"range_min", &raw.range_min_m},           {"range_max", &raw.range_max_m}};
  for (const auto& [name, field] : fields) {
    const auto value = number(name);
    if (!value) return value.error();
    *field = static_cast<float>(*value);
  }
  raw.ranges_m = ranges_;
  raw.intensities = intensities_;
  return raw;
}

Result<Odometry> EchoDocument::odometry() const {
  const auto when = stamp();
  if (!when) return when.error();
  const auto pose = planar_pose("pose.pose.");
  if (!pose) return pose.error();
  Odometry odometry{*when, *pose, std::nullopt, "odometry"};
  const auto x = number("twist.twist.linear.x");
  const auto y = number("twist.twist.linear.y");
  const auto turn = number("twist.twist.angular.z");
  if (x && y && turn && std::isfinite(*x) && std::isfinite(*y) && std::isfinite(*turn))
    odometry.twist_per_s = Twist2{*x, *y, *turn};
  return odometry;
}

Result<ReferencePose> EchoDocument::pose() const {
  const auto when = stamp();
  if (!when) return when.error();
  const auto pose = planar_pose(scalars_.contains("pose.pose.position.x") ? "pose.pose." : "pose.");
  if (!pose) return pose.error();
  return ReferencePose{*when, *pose, std::nullopt, "pose"};
}

}  // namespace beaconless::io
