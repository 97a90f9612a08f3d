// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "beaconless/scan/scan.hpp"

namespace beaconless::sim {
namespace {

constexpr double kLeastEdge_m = 0.1;
constexpr float kNoReturn = std::numeric_limits<float>::infinity();

Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

float report(double range_m, const LidarConfig& config) {
  if (config.range_step_m > 0.0) range_m = std::round(range_m / config.range_step_m) * config.range_step_m;
  if (range_m > config.range_max_m) return kNoReturn;
  if (range_m < config.range_min_m) return -kNoReturn;
  return static_cast<float>(range_m);
}

/// A range between what the beam's two edges see, where they see different things.
std::optional<double> mixed_range_m(const World& world, const LidarConfig& config,
                                    const Pose2& map_from_laser, double bearing_rad, double time_s,
                                    double middle_m, double share) {
  const double heading = map_from_laser.theta_rad + bearing_rad;
  const double half = 0.5 * config.angle_step_rad();
  const auto left =
      world.range_m(map_from_laser.translation(), unit(heading + half), config.range_max_m, time_s);
  const auto right =
      world.range_m(map_from_laser.translation(), unit(heading - half), config.range_max_m, time_s);
  if (!left || !right) return std::nullopt;
  const double gap_m = std::abs(*left - *right);
  // On one wall, however grazing, the middle lies midway; at an edge it belongs to one of the two sides.
  const bool one_wall = std::abs(*left + *right - 2.0 * middle_m) < 0.5 * gap_m;
  if (one_wall || gap_m < std::max(kLeastEdge_m, 10.0 * config.range_sigma_m)) return std::nullopt;
  return *left + share * (*right - *left);
}

}  // namespace

double LidarConfig::angle_step_rad() const {
  return radians(angle_max_deg - angle_min_deg) / std::max(1, beam_count - 1);
}

double LidarConfig::beam_time_s() const {
  return sweep == Sweep::instantaneous ? 0.0 : angle_step_rad() / (2.0 * kPi * rate_hz);
}

void describe(Fields& fields, LidarConfig& config) {
  fields("beam_count", config.beam_count, {2, static_cast<double>(Scan::kMaxBeams)}, "beams of one sweep");
  fields("angle_min_deg", config.angle_min_deg, {-360, 360},
         "bearing of the first beam, from straight ahead");
  fields("angle_max_deg", config.angle_max_deg, {-360, 360},
         "bearing of the last beam, above that of the first");
  fields("rate_hz", config.rate_hz, {0.1, 1000}, "turns of the mirror per second, one sweep each");
  fields("sweep", config.sweep, {"rotating", "instantaneous"},
         "beams one after the other, or all at the stamp");
  fields("range_min_m", config.range_min_m, {0, 1000}, "nearer things are reported as too close");
  fields("range_max_m", config.range_max_m, {0.01, 10000}, "further things are not seen");
  fields("range_sigma_m", config.range_sigma_m, {0, 10},
         "standard deviation of the Gaussian noise of a range");
  fields("range_step_m", config.range_step_m, {0, 1}, "ranges are whole multiples of this; 0: as they are");
  fields("mixed_pixel_share", config.mixed_pixel_share, {0, 1},
         "share of the beams at an edge that hang in the air");
  fields("dropout_share", config.dropout_share, {0, 1}, "share of the beams that see nothing for no reason");
}

RawScan measure_sweep(const World& world, const LidarConfig& config, const LaserMotion& map_from_laser,
                      double time_s, Rng& rng) {
  RawScan scan;
  scan.stamp = Stamp::from_seconds(time_s);
  scan.frame_id = "laser";
  scan.angle_min_rad = static_cast<float>(radians(config.angle_min_deg));
  scan.angle_increment_rad = static_cast<float>(config.angle_step_rad());
  scan.time_increment_s = static_cast<float>(config.beam_time_s());
  scan.scan_time_s = static_cast<float>(1.0 / config.rate_hz);
  scan.range_min_m = static_cast<float>(config.range_min_m);
  scan.range_max_m = static_cast<float>(config.range_max_m);
  scan.ranges_m.reserve(static_cast<std::size_t>(config.beam_count));

  Rng faults = rng.fork(1);
  Pose2 pose = map_from_laser(time_s);
  for (int i = 0; i < config.beam_count; ++i) {
    const double at_s = time_s + i * config.beam_time_s();
    if (config.sweep == Sweep::rotating && i > 0) pose = map_from_laser(at_s);
    const double bearing =
        static_cast<double>(scan.angle_min_rad) + i * static_cast<double>(scan.angle_increment_rad);
    auto range = world.range_m(pose.translation(), unit(pose.theta_rad + bearing), config.range_max_m, at_s);
    const double noise = rng.normal(config.range_sigma_m);
    if (range && config.mixed_pixel_share > 0.0 && faults.uniform() < config.mixed_pixel_share)
      if (const auto mixed = mixed_range_m(world, config, pose, bearing, at_s, *range, faults.uniform()))
        range = mixed;
    if (config.dropout_share > 0.0 && faults.uniform() < config.dropout_share) range.reset();
    scan.ranges_m.push_back(range ? report(*range + noise, config) : kNoReturn);
  }
  return scan;
}

}  // namespace beaconless::sim
