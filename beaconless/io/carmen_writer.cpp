// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_writer.hpp"

#include <cmath>

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
  if (!base_from_laser_ || is_place_put_) return;
  std::string place;
  append(place, *base_from_laser_);
  param("base_from_laser", place.substr(1));
  is_place_put_ = true;
}

void CarmenWriter::place_laser(const Pose2& base_from_laser) {
  if (!base_from_laser_) base_from_laser_ = base_from_laser;
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

}  // namespace beaconless::io
