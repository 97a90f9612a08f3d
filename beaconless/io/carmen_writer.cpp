// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <zlib.h>

#include "beaconless/io/carmen_line.hpp"
#include "beaconless/io/float_text.hpp"

namespace beaconless::io {
namespace {

constexpr std::string_view kHost = "beaconless";
constexpr float kSickAccuracy_m = 0.01F;  // a field that no reader uses

gzFile gz(void* file) { return static_cast<gzFile>(file); }

template <class Number>
void append(std::string& line, Number value) {
  line += ' ';
  append_number(line, value);
}

void append(std::string& line, const Pose2& pose) {
  append(line, pose.x_m);
  append(line, pose.y_m);
  append(line, pose.theta_rad);
}

void append_stamp(std::string& line, Stamp stamp) {
  const std::string text = to_string(stamp);
  line.append(" ").append(text).append(" ").append(kHost).append(" ").append(text).append("\n");
}

}  // namespace

void CarmenWriter::Close::operator()(void* gz_file) const { gzclose(gz(gz_file)); }

CarmenWriter::CarmenWriter(const std::string& path, std::string_view comment)
    : file_(gzopen(path.c_str(), path.ends_with(".gz") ? "wb6" : "wbT")), good_(file_ != nullptr) {
  put("# CARMEN log written by beaconless\n");
  while (!comment.empty()) {
    const std::size_t end = comment.find('\n');
    put("# " + std::string(comment.substr(0, end)) + "\n");
    comment.remove_prefix(end == std::string_view::npos ? comment.size() : end + 1);
  }
}

void CarmenWriter::put(const std::string& text) {
  good_ = good_ && file_ &&
          gzwrite(gz(file_.get()), text.data(), static_cast<unsigned>(text.size())) ==
              static_cast<int>(text.size());
}

void CarmenWriter::put_params(const RawScan& scan) {
  const auto param = [&](const char* name, const std::string& value) {
    std::string line = std::string("PARAM beaconless_laser_") + name + " " + value;
    append_stamp(line, scan.stamp);
    put(line);
  };
  const auto number = [&](const char* name, float value, float& last) {
    if (value == last || !std::isfinite(value)) return;
    std::string text;
    append_number(text, value);
    param(name, text);
    last = value;
  };
  number("range_min", scan.range_min_m, last_.range_min_m);
  number("time_increment", scan.time_increment_s, last_.time_increment_s);
  number("scan_time", scan.scan_time_s, last_.scan_time_s);
  if (scan.frame_id != last_.frame_id) param("frame_id", to_carmen_word(scan.frame_id));
  last_.frame_id = scan.frame_id;
}

void CarmenWriter::put_scan(const char* keyword, const RawScan& scan, const std::string& poses) {
  put_params(scan);
  const auto steps = static_cast<float>(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1);
  std::string line = std::string(keyword) + " 0";
  append(line, scan.angle_min_rad);
  append(line, steps * std::abs(scan.angle_increment_rad));
  append(line, scan.angle_increment_rad);
  append(line, scan.range_max_m);
  append(line, kSickAccuracy_m);
  line += scan.intensities.empty() ? " 0" : " 1";
  line += " " + std::to_string(scan.ranges_m.size());
  for (const float range : scan.ranges_m) append(line, range);
  line += " " + std::to_string(scan.intensities.size());
  for (const float intensity : scan.intensities) append(line, intensity);
  line += poses;
  append_stamp(line, scan.stamp);
  put(line);
}

void CarmenWriter::write(const RawScan& scan) { put_scan("RAWLASER1", scan, ""); }

void CarmenWriter::write(const RawScan& scan, const Pose2& map_from_base, const Pose2& base_from_laser) {
  std::string poses;
  append(poses, map_from_base * base_from_laser);
  append(poses, map_from_base);
  poses += " 0 0 0 0 0";  // velocities, safety distances, turn axis
  put_scan("ROBOTLASER1", scan, poses);
}

void CarmenWriter::write(const Scan& scan) { write(raw_from(scan)); }

void CarmenWriter::write(const Scan& scan, const Pose2& map_from_base, const Pose2& base_from_laser) {
  write(raw_from(scan), map_from_base, base_from_laser);
}

void CarmenWriter::write(const Odometry& odometry) {
  const Twist2 twist = odometry.twist_per_s.value_or(Twist2{});
  std::string line = "ODOM";
  append(line, odometry.odom_from_base);
  append(line, twist.x_m);
  append(line, twist.theta_rad);
  line += " 0";
  append_stamp(line, odometry.stamp);
  put(line);
}

void CarmenWriter::write(const ReferencePose& reference) {
  std::string line = "TRUEPOS";
  append(line, reference.map_from_base);
  line += " 0 0 0";
  append_stamp(line, reference.stamp);
  put(line);
}

bool CarmenWriter::close() {
  if (file_ && gzclose(gz(file_.release())) != Z_OK) good_ = false;
  return good_;
}

RawScan raw_from(const Scan& scan) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  RawScan raw;
  raw.stamp = scan.stamp();
  raw.frame_id = scan.frame_id();
  raw.angle_min_rad = static_cast<float>(scan.angle_min_rad());
  raw.angle_increment_rad = static_cast<float>(scan.angle_increment_rad());
  raw.scan_time_s = static_cast<float>(scan.scan_time_s());
  raw.range_min_m = static_cast<float>(scan.range_min_m());
  raw.range_max_m = std::isfinite(scan.range_max_m()) ? static_cast<float>(scan.range_max_m()) : 0.0F;
  raw.ranges_m.assign(scan.ranges_m().begin(), scan.ranges_m().end());
  raw.intensities.assign(scan.intensities().begin(), scan.intensities().end());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.beams()[i] == Beam::no_return) raw.ranges_m[i] = kInf;
    if (scan.beams()[i] == Beam::too_close) raw.ranges_m[i] = -kInf;
    if (scan.beams()[i] == Beam::invalid) raw.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  if (scan.size() < 2) return raw;
  raw.time_increment_s = static_cast<float>(scan.beam_time_s(1) - scan.beam_time_s(0));
  if (raw.time_increment_s < 0.0F) {  // the sweep ran clockwise: its first beam in time is the last here
    raw.time_increment_s = -raw.time_increment_s;
    raw.angle_min_rad += static_cast<float>(scan.size() - 1) * raw.angle_increment_rad;
    raw.angle_increment_rad = -raw.angle_increment_rad;
    std::reverse(raw.ranges_m.begin(), raw.ranges_m.end());
    std::reverse(raw.intensities.begin(), raw.intensities.end());
  }
  return raw;
}

}  // namespace beaconless::io
