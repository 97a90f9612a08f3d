// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr double kMaxPosition_m = 1e9;  // beyond it a coordinate is damage, not a place

struct Sector {
  double start_deg;
  double step_deg;
};

Sector sector_of(std::size_t beams) {
  switch (beams) {
    case 101:
      return {-50.0, 1.0};
    case 201:
      return {-50.0, 0.5};
    case 401:
      return {-50.0, 0.25};
    default:
      break;
  }
  const std::size_t steps = beams % 2 == 0 ? beams : std::max<std::size_t>(beams - 1, 1);
  return {-90.0, 180.0 / static_cast<double>(steps)};
}

Error bad(std::string what) { return Error{"", std::move(what), ""}; }

Result<float> take_float(std::string_view& rest, const char* name) {
  const std::string_view word = take_word(rest);
  if (const auto value = parse_float(word)) return *value;
  return bad(std::string(name) + " is '" + shown(word) + "', not a number");
}

/// `n value …`: the memory follows from the words that are there, not from what n promises.
Result<std::vector<float>> take_counted(std::string_view& rest, const char* name) {
  const std::string_view word = take_word(rest);
  const auto count = parse_int<std::uint64_t>(word);
  if (!count) return bad(std::string("the number of ") + name + " is '" + shown(word) + "'");
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(*count, rest.size() / 2)));
  for (std::uint64_t i = 0; i < *count; ++i) {
    const std::string_view text = take_word(rest);
    if (text.empty())
      return bad("promises " + std::to_string(*count) + " " + name + " but ends after " + std::to_string(i));
    const auto value = parse_float(text);
    if (!value) return bad(std::string(name) + " hold '" + shown(text) + "', not a number");
    values.push_back(*value);
  }
  return values;
}

Result<Pose2> take_pose(std::string_view& rest) {
  std::array<double, 3> values{};
  for (double& value : values) {
    const std::string_view word = take_word(rest);
    const auto number = parse_double(word);
    if (!number || !(std::abs(*number) < kMaxPosition_m))
      return bad("a pose holds '" + shown(word) + "'" + (word.empty() ? ": the line ends early" : ""));
    value = *number;
  }
  return Pose2{values[0], values[1], values[2]};
}

/// `ipc_stamp host logger_stamp`: the first is when the message was sent. Where it is missing, the logger's
/// counts.
Result<Stamp> take_stamp(std::string_view& rest) {
  const std::string_view words[] = {take_word(rest), take_word(rest), take_word(rest)};
  if (const std::string_view more = take_word(rest); !more.empty())
    return bad("has more words than its counts tell ('" + shown(more) + "' and on)");
  if (words[0].empty()) return bad("has no stamp: the line ends early");
  if (const auto stamp = parse_stamp(words[0])) return *stamp;
  if (words[2].empty())
    if (const auto stamp = parse_stamp(words[1])) return *stamp;
  return bad("has the stamp '" + shown(words[0]) + "'");
}

/// FLASER n ranges x y th odom_x odom_y odom_th stamp host stamp
Result<CarmenScan> parse_old(std::string_view rest, float range_max_m, bool has_robot_pose) {
  CarmenScan scan;
  auto ranges = take_counted(rest, "ranges");
  if (!ranges) return ranges.error();
  scan.raw.ranges_m = std::move(ranges).value();
  const auto laser = take_pose(rest);
  if (!laser) return laser.error();
  scan.map_from_laser = *laser;
  const auto robot = has_robot_pose ? take_pose(rest) : laser;
  if (!robot) return robot.error();
  scan.map_from_base = *robot;
  const auto stamp = take_stamp(rest);
  if (!stamp) return stamp.error();
  scan.raw.stamp = *stamp;
  const Sector sector = sector_of(scan.raw.ranges_m.size());
  scan.raw.angle_min_rad = static_cast<float>(radians(sector.start_deg));
  scan.raw.angle_increment_rad = static_cast<float>(radians(sector.step_deg));
  scan.raw.range_max_m = range_max_m;
  return scan;
}

/// type start_angle fov resolution max_range accuracy remission_mode n ranges m remissions
/// [laser_x y th robot_x y th tv rv forward_safety side_safety turn_axis] stamp host stamp
Result<CarmenScan> parse_new(std::string_view rest, bool has_poses) {
  CarmenScan scan;
  std::array<float, 7> head{};
  constexpr std::array kNames{"laser type", "start angle", "field of view", "resolution",
                              "max range",  "accuracy",    "remission mode"};
  for (std::size_t i = 0; i < head.size(); ++i) {
    const auto value = take_float(rest, kNames[i]);
    if (!value) return value.error();
    head[i] = *value;
  }
  scan.raw.angle_min_rad = head[1];
  scan.raw.angle_increment_rad = head[3];
  scan.raw.range_max_m = head[4];
  auto ranges = take_counted(rest, "ranges");
  if (!ranges) return ranges.error();
  auto intensities = take_counted(rest, "remissions");
  if (!intensities) return intensities.error();
  scan.raw.ranges_m = std::move(ranges).value();
  scan.raw.intensities = std::move(intensities).value();
  if (has_poses) {
    const auto laser = take_pose(rest);
    if (!laser) return laser.error();
    const auto robot = take_pose(rest);
    if (!robot) return robot.error();
    scan.map_from_laser = *laser;
    scan.map_from_base = *robot;
    for (int i = 0; i < 5; ++i) take_word(rest);  // velocities and safety distances
  }
  const auto stamp = take_stamp(rest);
  if (!stamp) return stamp.error();
  scan.raw.stamp = *stamp;
  return scan;
}

bool is_numbered(std::string_view keyword, std::string_view stem, char first, char last) {
  return keyword.size() == stem.size() + 1 && keyword.starts_with(stem) && keyword.back() >= first &&
         keyword.back() <= last;
}

}  // namespace

void CarmenParams::take(std::string_view line) {
  take_word(line);
  const std::string_view name = take_word(line);
  const std::string_view word = take_word(line);
  const auto take_if = [&](std::string_view wanted, float& into, bool must_be_positive) {
    const auto value = name == wanted ? parse_float(word) : std::nullopt;
    if (value && std::isfinite(*value) && (!must_be_positive || *value > 0.0F)) into = *value;
  };
  if (name == "beaconless_laser_base_from_laser") {
    const std::array values{parse_double(word), parse_double(take_word(line)), parse_double(take_word(line))};
    const bool is_pose = std::all_of(values.begin(), values.end(),
                                     [](const auto& value) { return value && std::isfinite(*value); });
    if (is_pose) base_from_laser = Pose2{*values[0], *values[1], *values[2]};
  }
  take_if("robot_front_laser_max", front_max_m, true);
  take_if("robot_rear_laser_max", rear_max_m, true);
  take_if("beaconless_laser_range_min", range_min_m, false);
  take_if("beaconless_laser_time_increment", time_increment_s, false);
  take_if("beaconless_laser_scan_time", scan_time_s, false);
  if (name == "beaconless_laser_frame_id") frame_id = from_carmen_word(word);
}

bool is_carmen_scan(std::string_view keyword) {
  return keyword == "FLASER" || keyword == "RLASER" || keyword == "LASER_READING" ||
         is_numbered(keyword, "RAWLASER", '1', '4') || is_numbered(keyword, "ROBOTLASER", '0', '4');
}

Result<CarmenScan> parse_carmen_scan(std::string_view line, const CarmenParams& params) {
  const std::string_view keyword = take_word(line);
  auto scan = keyword == "FLASER"            ? parse_old(line, params.front_max_m, true)
              : keyword == "RLASER"          ? parse_old(line, params.rear_max_m, true)
              : keyword == "LASER_READING"   ? parse_old(line, params.front_max_m, false)
              : keyword.starts_with("ROBOT") ? parse_new(line, true)
                                             : parse_new(line, false);
  if (!scan) return scan;
  RawScan& raw = scan.value().raw;
  raw.range_min_m = params.range_min_m;
  raw.time_increment_s = params.time_increment_s;
  raw.scan_time_s = params.scan_time_s;
  raw.frame_id = params.frame_id;
  return scan;
}

Result<Odometry> parse_carmen_odometry(std::string_view line) {
  Odometry odometry;
  odometry.source = take_word(line);
  const auto pose = take_pose(line);
  if (!pose) return pose.error();
  odometry.odom_from_base = *pose;
  std::string_view ahead = line;
  for (int i = 0; i < 3; ++i) take_word(ahead);
  if (!take_word(ahead).empty()) {  // GMapping's short form goes straight on to the stamp
    std::array<double, 3> motion{};
    for (double& value : motion) {
      const std::string_view word = take_word(line);
      const auto number = parse_double(word);
      if (!number || !std::isfinite(*number)) return bad("a velocity is '" + shown(word) + "'");
      value = *number;
    }
    if (motion != std::array{0.0, 0.0, 0.0}) odometry.twist_per_s = Twist2{motion[0], 0.0, motion[1]};
  }
  const auto stamp = take_stamp(line);
  if (!stamp) return stamp.error();
  odometry.stamp = *stamp;
  return odometry;
}

Result<ReferencePose> parse_carmen_true_pose(std::string_view line) {
  ReferencePose reference;
  reference.source = take_word(line);
  const auto pose = take_pose(line);
  if (!pose) return pose.error();
  const auto odometry = take_pose(line);
  if (!odometry) return odometry.error();
  const auto stamp = take_stamp(line);
  if (!stamp) return stamp.error();
  reference.map_from_base = *pose;
  reference.stamp = *stamp;
  return reference;
}

std::string to_carmen_word(std::string_view frame_id) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string word;
  for (const char c : frame_id) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 0x20 && byte != '%' && byte != 0x7F) {
      word += c;
    } else {
      word += '%';
      word += kHex[byte >> 4U];
      word += kHex[byte & 15U];
    }
  }
  return word.empty() ? "%" : word;
}

std::string from_carmen_word(std::string_view word) {
  std::string frame_id;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned byte = 0;
    const char* digits = word.data() + i + 1;
    if (word[i] == '%' && i + 2 < word.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      frame_id += static_cast<char>(byte);
      i += 2;
    } else if (word != "%") {
      frame_id += word[i];
    }
  }
  return frame_id;
}

}  // namespace beaconless::io
