// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/laser_place.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace beaconless::io {
namespace {

constexpr int kMaxDepth = 64;            // of a tree of frames; a ring ends there too
constexpr double kLeastUpright = 0.966;  // cos 15°

std::string without_slash(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

std::optional<Eigen::Isometry3d> rigid(const FrameTransform& transform) {
  if (!transform.planar().is_finite() || !std::isfinite(transform.translation_m.z())) return std::nullopt;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = transform.rotation.normalized().toRotationMatrix();
  result.translation() = transform.translation_m;
  return result;
}

}  // namespace

Result<std::optional<LaserPlace>> laser_place(const std::vector<FrameTransform>& fixed,
                                              const std::string& laser_frame,
                                              const std::vector<std::string>& bases) {
  std::map<std::string, const FrameTransform*> parents;
  for (const FrameTransform& transform : fixed) parents[without_slash(transform.child)] = &transform;
  std::optional<Eigen::Isometry3d> found;
  std::size_t best = bases.size();
  Eigen::Isometry3d here_from_laser = Eigen::Isometry3d::Identity();
  std::string here = without_slash(laser_frame);
  for (int depth = 0; depth < kMaxDepth; ++depth) {
    const auto rank = static_cast<std::size_t>(std::find(bases.begin(), bases.end(), here) - bases.begin());
    if (rank < best) best = rank, found = here_from_laser;
    const auto up = parents.find(here);
    if (up == parents.end()) break;
    const auto step = rigid(*up->second);
    if (!step) break;
    here_from_laser = *step * here_from_laser;
    here = without_slash(up->second->parent);
  }
  if (!found) return std::optional<LaserPlace>();
  const std::string way = bases[best] + " -> " + without_slash(laser_frame);
  const Eigen::Matrix3d turn = found->linear();
  if (turn(2, 2) < kLeastUpright)
    return Error{
        way, turn(2, 2) < 0.0 ? "the laser hangs upside down" : "the laser is tilted",
        "tell its place by --base-from-laser; for one that hangs upside down, turn its ranges round"};
  return std::optional(
      LaserPlace{{found->translation().x(), found->translation().y(), std::atan2(turn(1, 0), turn(0, 0))},
                 way,
                 bases[best]});
}

}  // namespace beaconless::io
