// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/checks.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <unistd.h>

#include "beaconless/io/ros_events.hpp"

namespace beaconless::fuzz {
namespace {

void check(const Scan& scan) {
  require(scan.size() > 0 && scan.size() <= Scan::kMaxBeams, "a scan has 1 to kMaxBeams beams");
  require(scan.beams().size() == scan.size() && scan.x_m().size() == scan.size() &&
              scan.y_m().size() == scan.size(),
          "a beam has a kind and a point");
  require(std::isfinite(scan.angle_min_rad()) && std::isfinite(scan.angle_increment_rad()) &&
              scan.angle_increment_rad() > 0,
          "angles are finite and grow");
  require(std::isfinite(scan.range_min_m()) && !std::isnan(scan.range_max_m()), "limits are numbers");
  require(std::isfinite(scan.scan_time_s()) && std::isfinite(scan.sweep_time_s()) &&
              std::isfinite(scan.beam_time_s(0)) && std::isfinite(scan.beam_time_s(scan.size() - 1)),
          "times are finite");
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float range = scan.ranges_m()[i];
    require(std::isfinite(range) && std::isfinite(scan.x_m()[i]) && std::isfinite(scan.y_m()[i]),
            "ranges and points are finite");
    require(scan.beams()[i] <= Beam::invalid, "a beam is of a known kind");
    if (scan.is_hit(i)) {
      ++hits;
      require(range > 0.0F, "a hit has a range");
    } else {
      require(range == 0.0F && scan.x_m()[i] == 0.0F && scan.y_m()[i] == 0.0F, "nothing is at 0");
    }
  }
  require(hits == scan.hit_count(), "hits are counted");
  require(scan.intensities().empty() || scan.intensities().size() == scan.size(), "an intensity a beam");
  for (const float intensity : scan.intensities())
    require(std::isfinite(intensity), "intensities are finite");
}

void check(const Odometry& odometry) {
  require(odometry.odom_from_base.is_finite(), "odometry is finite");
  if (const auto& twist = odometry.twist_per_s)
    require(std::isfinite(twist->x_m) && std::isfinite(twist->y_m) && std::isfinite(twist->theta_rad),
            "a twist is finite");
}

void check(const ReferencePose& reference) {
  require(reference.map_from_base.is_finite(), "a reference pose is finite");
  require(!reference.base_from_laser || reference.base_from_laser->is_finite(), "a laser place is finite");
}

std::size_t pass_over(const io::Recording& recording) {
  std::size_t events = 0;
  for (const Event& event : recording) {
    fuzz::check(event);
    ++events;
  }
  return events;
}

}  // namespace

void require(bool holds, const char* what) {
  if (!holds) throw BrokenPromise(what);
}

InputFolder::InputFolder()
    : path_(std::filesystem::temp_directory_path() / ("beaconless-fuzz-" + std::to_string(getpid()))) {
  std::filesystem::create_directories(path_);
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string InputFolder::write(const std::string& name, Bytes bytes) const {
  const std::string path = (path_ / name).string();
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error("no room for " + path);
  return path;
}

void check(const Error& error) { require(!error.what.empty(), "an error says what is wrong"); }

void check(const Event& event) {
  std::visit([](const auto& e) { check(e); }, event);
}

void read_recording(const OpenRecording& open, Bytes bytes) {
  static const InputFolder folder;
  const std::string path = folder.write("input", bytes);
  io::RecordingOptions options;
  options.scans_optional = true;
  options.on_problem = [](const io::Problem& problem) {
    require(!problem.where.empty() && !problem.what.empty(), "a problem has a place and a name");
  };
  auto recording = open(path, options);
  if (recording && recording->scan_topic().empty()) {  // several: take the first one
    const auto& topics = recording->topics();
    const auto scans = std::find_if(topics.begin(), topics.end(), [](const io::Topic& topic) {
      return io::is_laser_scan_type(topic.type);
    });
    if (scans != topics.end()) {
      options.topic = scans->name;
      recording = open(path, options);
    }
  }
  if (!recording) return check(recording.error());
  if (const auto& place = recording->laser_place())
    require(place->base_from_laser.is_finite(), "the laser's place is finite");
  const std::size_t events = pass_over(*recording);
  require(pass_over(*recording) == events, "two passes see the same events");
}

}  // namespace beaconless::fuzz
