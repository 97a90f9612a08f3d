// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/drive.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless::sim {
namespace {

/// What is covered `time_s` after rest while the speed rises to `full_speed` along half a cosine.
double covered_on_ramp(double full_speed, double time_s) {
  return 0.5 * full_speed * (time_s - Drive::kRamp_s / kPi * std::sin(kPi * time_s / Drive::kRamp_s));
}

/// Seconds for a way from rest to rest: both ramps together cover what one ramp's time at full speed would.
double ride_s(double way, double full_speed) {
  return full_speed > 0.0 ? way / full_speed + Drive::kRamp_s : 0.0;
}

double covered(double way, double full_speed, double time_s) {
  const double left_s = ride_s(way, full_speed) - time_s;
  if (time_s <= 0.0) return 0.0;
  if (left_s <= 0.0) return way;
  if (time_s < Drive::kRamp_s) return covered_on_ramp(full_speed, time_s);
  if (left_s < Drive::kRamp_s) return way - covered_on_ramp(full_speed, left_s);
  return full_speed * (time_s - 0.5 * Drive::kRamp_s);
}

/// An ellipse driven at a steady speed: a table from the way to the eccentric anomaly.
class EllipseTrack {
 public:
  explicit EllipseTrack(const Ellipse& path)
      : map_from_ellipse_{path.center_x_m, path.center_y_m, radians(path.heading_deg)},
        a_m_(path.semi_axis_x_m),
        b_m_(path.semi_axis_y_m),
        start_rad_(radians(path.start_deg)),
        sign_(path.turns < 0.0 ? -1.0 : 1.0) {
    way_m_.push_back(0.0);
    for (int i = 1; i <= kSteps; ++i) {  // Simpson's rule on each step
      const double at = anomaly_rad(i - 1);
      const double to = anomaly_rad(i);
      way_m_.push_back(way_m_.back() +
                       kStep_rad / 6.0 * (stretch_m(at) + 4.0 * stretch_m(0.5 * (at + to)) + stretch_m(to)));
    }
  }

  double around_m() const { return way_m_.back(); }

  Pose2 at(double way_m) const {
    const double rest_m = std::clamp(way_m - around_m() * std::floor(way_m / around_m()), 0.0, around_m());
    const auto next = std::upper_bound(way_m_.begin() + 1, way_m_.end() - 1, rest_m);
    const double part = (rest_m - *(next - 1)) / (*next - *(next - 1));
    const double anomaly = anomaly_rad(static_cast<double>(next - way_m_.begin()) - 1.0 + part);
    const double c = std::cos(anomaly);
    const double s = std::sin(anomaly);
    return map_from_ellipse_ * Pose2{a_m_ * c, b_m_ * s, std::atan2(sign_ * b_m_ * c, -sign_ * a_m_ * s)};
  }

 private:
  static constexpr int kSteps = 4096;
  static constexpr double kStep_rad = 2.0 * kPi / kSteps;

  double anomaly_rad(double steps) const { return start_rad_ + sign_ * steps * kStep_rad; }
  double stretch_m(double anomaly_rad) const {  // metres per radian of anomaly
    return std::hypot(a_m_ * std::sin(anomaly_rad), b_m_ * std::cos(anomaly_rad));
  }

  Pose2 map_from_ellipse_;
  double a_m_;
  double b_m_;
  double start_rad_;
  double sign_;
  std::vector<double> way_m_;  // after each step of the anomaly, once around
};

}  // namespace

Drive::Drive(const Path& path) {
  std::visit([this](const auto& kind) { add(kind); }, path);
}

Pose2 Drive::map_from_base(double time_s) const {
  const auto next = std::upper_bound(legs_.begin() + 1, legs_.end(), time_s,
                                     [](double t, const Leg& leg) { return t < leg.start_s; });
  const Leg& leg = *(next - 1);
  return leg.pose(covered(leg.way, leg.full_speed, time_s - leg.start_s));
}

void Drive::add_leg(double way, double speed, std::function<Pose2(double)> pose) {
  const double full_speed = std::min(speed, way / kRamp_s);
  legs_.push_back({duration_s_, way, full_speed, std::move(pose)});
  duration_s_ += ride_s(way, full_speed);
}

void Drive::add_turn(const Pose2& start, double angle_rad, double rate_degps) {
  add_leg(std::abs(angle_rad), radians(rate_degps), [start, angle_rad](double turned) {
    return start * Pose2{0.0, 0.0, std::copysign(turned, angle_rad)};
  });
}

void Drive::add(const Standing& path) { add_turn({path.x_m, path.y_m, radians(path.heading_deg)}, 0.0, 0.0); }

void Drive::add(const Turning& path) {
  add_turn({path.x_m, path.y_m, radians(path.heading_deg)}, radians(path.angle_deg), path.rate_degps);
}

void Drive::add(const Ellipse& path) {
  const EllipseTrack track(path);
  add_leg(std::abs(path.turns) * track.around_m(), path.speed_mps,
          [track](double way_m) { return track.at(way_m); });
}

void Drive::add(const Waypoints& path) {
  Pose2 at;
  if (!path.points.empty()) at = {path.points.front().x(), path.points.front().y(), 0.0};
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector2d way = path.points[i] - path.points[i - 1];
    if (way.norm() <= 0.0) continue;
    const double heading = std::atan2(way.y(), way.x());
    if (legs_.empty()) at.theta_rad = heading;
    add_turn(at, wrap_angle(heading - at.theta_rad), path.rate_degps);
    at.theta_rad = heading;
    add_leg(way.norm(), path.speed_mps, [at](double way_m) { return at * Pose2{way_m, 0.0, 0.0}; });
    at = {path.points[i].x(), path.points[i].y(), heading};
  }
  if (legs_.empty()) add_turn(at, 0.0, 0.0);
}

}  // namespace beaconless::sim
