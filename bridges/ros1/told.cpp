// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/told.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/quaternion_yaw.hpp"
#include "beaconless/scan/deskew.hpp"

namespace beaconless::ros1 {
namespace {

constexpr double kSameMotion_s = 1.0;
constexpr std::array kGreen{0.1F, 0.8F, 0.2F};
constexpr std::array kYellow{0.9F, 0.7F, 0.0F};
constexpr std::array kRed{0.9F, 0.1F, 0.1F};

Level level_of(const PoseEstimate& estimate) {
  if (estimate.status == Status::lost) return Level::error;
  return estimate.is_trusted() ? Level::ok : Level::warn;
}

std::string words_of(const PoseEstimate& estimate) {
  if (estimate.is_trusted()) return "ok";
  if (estimate.ok()) return "ok, but other places may fit as well: drive slowly, do not dock";
  return std::string(to_string(estimate.status)) + ": " + std::string(estimate.reason);
}

}  // namespace

Transform transform_of(const Pose2& a_from_b) {
  return {a_from_b.x_m,
          a_from_b.y_m,
          0.0,
          0.0,
          0.0,
          std::sin(a_from_b.theta_rad / 2.0),
          std::cos(a_from_b.theta_rad / 2.0)};
}

Result<Pose2> pose_of(const Transform& a_from_b) {
  const Transform& t = a_from_b;
  const auto yaw_rad = io::yaw_rad_of_quaternion(t.qx, t.qy, t.qz, t.qw);
  if (!yaw_rad || !std::isfinite(t.x_m) || !std::isfinite(t.y_m))
    return Error{"tf", "a transform is not finite, or its quaternion is of length zero", ""};
  return Pose2{t.x_m, t.y_m, *yaw_rad};
}

PoseMessage pose_message(const PoseEstimate& estimate, const std::string& frame) {
  PoseMessage message{estimate.stamp.ns, frame, transform_of(estimate.map_from_base), {}};
  constexpr std::array<std::size_t, 3> kRows{0, 1, 5};  // x, y and yaw among six
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      message.covariance[6 * kRows[i] + kRows[k]] =
          estimate.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  return message;
}

PosesMessage places_message(const PoseEstimate& estimate, std::span<const PoseCandidate> candidates,
                            const std::string& frame) {
  PosesMessage message{estimate.stamp.ns, frame, {}};
  for (const PoseCandidate& candidate : candidates)
    message.poses.push_back(transform_of(candidate.map_from_base));
  if (message.poses.empty() && (estimate.ok() || estimate.status == Status::degraded))
    message.poses.push_back(transform_of(estimate.map_from_base));
  return message;
}

PointsMessage beams_message(const std::optional<PoseEstimate>& before, const PoseEstimate& estimate,
                            const Scan& scan, const Pose2& base_from_laser, const std::string& frame) {
  PointsMessage message{estimate.stamp.ns, frame, scan.frame_id(), {}, kRed};
  if (estimate.ok()) message.colour = kGreen;
  if (estimate.status == Status::degraded) message.colour = kYellow;
  const Pose2 map_from_laser = estimate.map_from_base * base_from_laser;
  const double since_s = before ? seconds_between(before->stamp, estimate.stamp) : 0.0;
  Twist2 per_s;
  if (since_s > 0.0 && since_s < kSameMotion_s && !estimate.jumped)
    per_s = 1.0 / since_s * ((before->map_from_base * base_from_laser).inverse() * map_from_laser).log();
  std::vector<Eigen::Vector2d> points;
  points_at_stamp(scan, per_s, points);
  message.points_m.reserve(points.size());
  for (const Eigen::Vector2d& seen : points) {
    const Eigen::Vector2d point = map_from_laser * seen;
    message.points_m.push_back({point.x(), point.y()});
  }
  return message;
}

std::string words_of_map(const Map& map) {
  if (const auto* grid = std::get_if<OccupancyGrid>(&map))
    return fmt::format("{} x {} cells of {:.3g} m", grid->width_cells, grid->height_cells,
                       grid->resolution_m);
  const std::size_t lines = std::get<FloorPlan>(map).walls.size();
  return fmt::format("a floor plan of {} line{}", lines, lines == 1 ? "" : "s");
}

DiagnosticMessage diagnostic_message(const std::optional<PoseEstimate>& estimate,
                                     const std::map<std::string, Complaints::Complaint>& complaints) {
  DiagnosticMessage message;
  message.level = estimate ? level_of(*estimate) : Level::warn;
  message.message = estimate ? words_of(*estimate) : "no scan was localized yet";
  for (const auto& [subject, complaint] : complaints) {
    message.values.emplace_back(subject, complaint.words);
    if (complaint.level <= message.level && message.level != Level::ok) continue;
    message.level = complaint.level;
    message.message = complaint.words;
  }
  if (!estimate) return message;
  const auto tell = [&](const char* key, std::string value) {
    message.values.emplace_back(key, std::move(value));
  };
  tell("status", std::string(to_string(estimate->status)));
  tell("reason", std::string(estimate->reason));
  tell("quality", fmt::format("{:.3f}", estimate->quality));
  tell("protection_m", fmt::format("{:.3f}", estimate->protection_m));
  tell("protection_deg", fmt::format("{:.3f}", degrees(estimate->protection_rad)));
  tell("stamp", to_string(estimate->stamp));
  return message;
}

}  // namespace beaconless::ros1
