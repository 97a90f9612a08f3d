// SPDX-License-Identifier: Apache-2.0
#include "beaconless/scan/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e5;  // no scanner sees so far, and squares of it stay well inside a float
constexpr double kLongestSweep_s = 60.0;  // nor turns so slowly

std::optional<Error> refuse(const RawScan& raw) {
  const std::string where = "scan at " + to_string(raw.stamp);
  if (raw.ranges_m.empty()) return Error{where, "has no beams", ""};
  if (raw.ranges_m.size() > Scan::kMaxBeams)
    return Error{where, "has " + std::to_string(raw.ranges_m.size()) + " beams, more than any scanner", ""};
  if (!raw.intensities.empty() && raw.intensities.size() != raw.ranges_m.size())
    return Error{where,
                 std::to_string(raw.intensities.size()) + " intensities for " +
                     std::to_string(raw.ranges_m.size()) + " ranges",
                 "the record is damaged"};
  if (!std::isfinite(raw.angle_min_rad) || std::abs(raw.angle_min_rad) > 100.0F)
    return Error{where, "angle_min is " + std::to_string(raw.angle_min_rad), "angles are radians"};
  const float step = std::abs(raw.angle_increment_rad);
  if (!std::isfinite(step) || step < 1e-6F || step > 3.2F)
    return Error{where, "angle_increment is " + std::to_string(raw.angle_increment_rad),
                 "beams need an angle step between 1e-6 and 3.2 rad"};
  return std::nullopt;
}

/// Seconds from one beam to the next; 0 where neither gate nor source tells any that a scanner could have.
double beam_step_s(const RawScan& raw, const ScanGate& gate) {
  const auto beams = static_cast<double>(raw.ranges_m.size());
  const auto can_be = [beams](double step_s) { return step_s > 0.0 && step_s * beams < kLongestSweep_s; };
  const double told_s = beams > 1.0 ? gate.sweep_time_s / (beams - 1.0) : 0.0;
  if (can_be(told_s)) return told_s;
  const auto own_s = static_cast<double>(raw.time_increment_s);
  return can_be(own_s) ? own_s : 0.0;
}

/// Keeps one turn: a beam within half a step of 360° after the first is the first one again.
void drop_second_turn(RawScan& raw) {
  const double fit = std::floor(2.0 * kPi / std::abs(static_cast<double>(raw.angle_increment_rad)) + 0.5);
  const std::size_t count = std::min(raw.ranges_m.size(), static_cast<std::size_t>(fit));
  raw.ranges_m.resize(count);
  if (!raw.intensities.empty()) raw.intensities.resize(count);
}

Beam judge(float range_m, double range_min_m, double range_max_m) {
  if (std::isnan(range_m) || range_m == 0.0F) return Beam::invalid;
  if (std::isinf(range_m)) return range_m > 0.0F ? Beam::no_return : Beam::too_close;
  if (range_m < 0.0F) return Beam::invalid;
  if (range_m >= range_max_m) return Beam::no_return;
  return range_m < range_min_m ? Beam::too_close : Beam::hit;
}

double finite_or_zero(float value) { return std::isfinite(value) ? static_cast<double>(value) : 0.0; }

}  // namespace

Result<Scan> Scan::make(RawScan raw, const ScanGate& gate) {
  if (auto error = refuse(raw)) return *error;

  Scan scan;
  scan.range_min_m_ = std::max({finite_or_zero(raw.range_min_m), static_cast<double>(gate.range_min_m), 0.0});
  scan.range_max_m_ =
      raw.range_max_m > 0.0F ? static_cast<double>(raw.range_max_m) : std::numeric_limits<double>::infinity();
  if (gate.range_max_m > 0.0F)
    scan.range_max_m_ = std::min(scan.range_max_m_, static_cast<double>(gate.range_max_m));
  if (scan.range_min_m_ >= scan.range_max_m_)
    return Error{"scan at " + to_string(raw.stamp),
                 "range_min " + std::to_string(scan.range_min_m_) + " m is not below range_max " +
                     std::to_string(scan.range_max_m_) + " m",
                 "no beam could be used"};

  const double step_s = beam_step_s(raw, gate);
  const double sweep_s = step_s * static_cast<double>(raw.ranges_m.size() - 1);
  const double late_s = gate.stamp_is == StampIs::first_beam  ? 0.0
                        : gate.stamp_is == StampIs::last_beam ? sweep_s
                                                              : 0.5 * sweep_s;
  scan.stamp_ = raw.stamp + -late_s;
  scan.scan_time_s_ = std::max(finite_or_zero(raw.scan_time_s), 0.0);

  drop_second_turn(raw);
  const std::size_t count = raw.ranges_m.size();
  scan.angle_min_rad_ = static_cast<double>(raw.angle_min_rad);
  scan.angle_increment_rad_ = static_cast<double>(raw.angle_increment_rad);
  scan.time_increment_s_ = step_s;
  if (raw.angle_increment_rad < 0.0F) {  // clockwise: turned round, so that bearings ascend
    const auto last = static_cast<double>(count - 1);
    scan.angle_min_rad_ += last * scan.angle_increment_rad_;
    scan.angle_increment_rad_ = -scan.angle_increment_rad_;
    scan.first_beam_time_s_ = last * step_s;
    scan.time_increment_s_ = -step_s;
    std::reverse(raw.ranges_m.begin(), raw.ranges_m.end());
    std::reverse(raw.intensities.begin(), raw.intensities.end());
  }

  scan.frame_id_ = std::move(raw.frame_id);
  scan.ranges_m_ = std::move(raw.ranges_m);
  scan.intensities_ = std::move(raw.intensities);
  for (float& intensity : scan.intensities_)
    if (!std::isfinite(intensity)) intensity = 0.0F;
  scan.beams_.resize(count);
  scan.x_m_.resize(count);
  scan.y_m_.resize(count);
  const double farthest_m = std::min(scan.range_max_m_, kFarthest_m);
  for (std::size_t i = 0; i < count; ++i) {
    scan.beams_[i] = judge(scan.ranges_m_[i], scan.range_min_m_, farthest_m);
    if (scan.beams_[i] != Beam::hit) {
      scan.ranges_m_[i] = 0.0F;
      continue;
    }
    ++scan.hit_count_;
    const Eigen::Vector2d at = static_cast<double>(scan.ranges_m_[i]) * scan.direction(i);
    scan.x_m_[i] = static_cast<float>(at.x());
    scan.y_m_[i] = static_cast<float>(at.y());
  }
  return scan;
}

bool Scan::is_full_circle() const {
  return std::abs(static_cast<double>(size()) * angle_increment_rad_ - 2.0 * kPi) <=
         0.5 * angle_increment_rad_;
}

Eigen::Vector2d Scan::direction(std::size_t beam) const {
  const double angle = angle_rad(beam);
  return {std::cos(angle), std::sin(angle)};
}

double Scan::beams_towards(const Eigen::Vector2d& point) const {
  const double turn = 2.0 * kPi;
  const double from_first = std::atan2(point.y(), point.x()) - angle_min_rad_;
  return (from_first - turn * std::floor(from_first / turn)) / angle_increment_rad_;
}

std::ostream& operator<<(std::ostream& out, const Scan& scan) {
  return out << "Scan(" << scan.stamp() << " s, " << scan.hit_count() << " hits of " << scan.size()
             << " beams, " << degrees(scan.angle_min_rad()) << " deg by "
             << degrees(scan.angle_increment_rad()) << " deg)";
}

}  // namespace beaconless
