// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/relations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace beaconless::eval {
namespace {

/// The pose nearest in time, the first of several equal ones; nothing where none is within the tolerance.
std::optional<Pose2> pose_near(const Trajectory& estimate, Stamp stamp, double tolerance_s) {
  const auto after =
      std::lower_bound(estimate.begin(), estimate.end(), stamp,
                       [](const StampedPose& pose, Stamp sought) { return pose.stamp < sought; });
  auto nearest = after;
  if (after == estimate.end() ||
      (after != estimate.begin() &&
       seconds_between(std::prev(after)->stamp, stamp) < seconds_between(stamp, after->stamp))) {
    if (after == estimate.begin()) return std::nullopt;
    nearest = std::prev(after);
  }
  if (!(std::abs(seconds_between(nearest->stamp, stamp)) <= tolerance_s)) return std::nullopt;
  return nearest->pose;
}

std::optional<Pose2> pose_of(const Trajectory& estimate, const PoseKey& key, const RelationKeys& keys) {
  if (const auto* stamp = std::get_if<Stamp>(&key))
    return pose_near(estimate, *stamp + -keys.clock_offset_s, keys.tolerance_s);
  const auto scan = static_cast<std::size_t>(std::get<std::uint64_t>(key));
  if (keys.scan_stamps.empty())
    return scan < estimate.size() ? std::optional(estimate[scan].pose) : std::nullopt;
  return scan < keys.scan_stamps.size() ? pose_near(estimate, keys.scan_stamps[scan], keys.tolerance_s)
                                        : std::nullopt;
}

}  // namespace

RelationEvaluation evaluate_relations(const Trajectory& estimate, std::span<const PoseRelation> relations,
                                      const RelationKeys& keys) {
  RelationEvaluation evaluation;
  evaluation.relation_count = relations.size();
  evaluation.errors.reserve(relations.size());
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
  translation_m.reserve(relations.size());
  rotation_deg.reserve(relations.size());
  for (std::size_t i = 0; i < relations.size(); ++i) {
    const auto from = pose_of(estimate, relations[i].from, keys);
    const auto to = pose_of(estimate, relations[i].to, keys);
    if (!from || !to || !from->is_finite() || !to->is_finite() || !relations[i].from_pose_to.is_finite()) {
      ++evaluation.without_pose_count;
      continue;
    }
    const Pose2 error = relations[i].from_pose_to.inverse() * (from->inverse() * *to);
    translation_m.push_back(std::hypot(error.x_m, error.y_m));
    rotation_deg.push_back(degrees(std::abs(error.theta_rad)));
    evaluation.errors.push_back({i, translation_m.back(), rotation_deg.back()});
  }
  evaluation.translation_m = statistics_of(std::move(translation_m));
  evaluation.rotation_deg = statistics_of(std::move(rotation_deg));
  return evaluation;
}

}  // namespace beaconless::eval
