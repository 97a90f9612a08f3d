// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/start_guess.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/quaternion_yaw.hpp"
#include "beaconless/map/wall_box.hpp"

namespace beaconless::ros1 {
namespace {

constexpr double kFurthest_m = 1e6;
constexpr double kStartAt_m = 1.0;  // what a localizer finds its way from, see its start_at
constexpr double kStartAt_rad = kPi / 4.0;
constexpr double kWidest_m = 100.0;
constexpr double kSearched_sigma = 3.0;
constexpr double kLeastRadius_m = 1.0;
constexpr double kFurthestSight_m = 100.0;

Error refused(std::string what, std::string remedy) {
  return {"initialpose", std::move(what), std::move(remedy)};
}

std::optional<Error> refuse_frame(const std::string& frame, const std::string& global_frame) {
  const std::string bare = frame.starts_with('/') ? frame.substr(1) : frame;
  if (bare == global_frame) return std::nullopt;
  return refused("its frame is \"" + frame + "\", the map's is \"" + global_frame + "\"",
                 "in RViz set Fixed Frame to " + global_frame);
}

std::optional<Error> refuse_covariance(double xx, double xy, double yy, double aa) {
  if (!std::isfinite(xx + xy + yy + aa))
    return refused("its covariance is not finite", "give variances of x, y and heading");
  // A rounding's worth below zero is no one's fault.
  constexpr double kRounding = 1e-9;
  if (xx < -kRounding || yy < -kRounding || aa < -kRounding ||
      xy * xy > xx * yy * (1.0 + kRounding) + kRounding)
    return refused("its covariance is none: a variance is negative, or x and y go along too well",
                   "give variances of x, y and heading, 0 or more");
  if (xx + yy > kWidest_m * kWidest_m)
    return refused(fmt::format("its standard deviation of {:.3g} m says nothing", std::sqrt(xx + yy)),
                   "to search the whole map, call global_localization");
  return std::nullopt;
}

}  // namespace

Result<StartGuess> start_guess_of(const PoseMessage& pose, const std::string& global_frame) {
  if (auto refusal = refuse_frame(pose.frame_id, global_frame)) return *refusal;
  const Transform& at = pose.pose;
  // Written so that NaN is refused too.
  if (!(std::abs(at.x_m) < kFurthest_m) || !(std::abs(at.y_m) < kFurthest_m))
    return refused(fmt::format("x {} m, y {} m is no place on a map", at.x_m, at.y_m),
                   "give finite metres in the frame " + global_frame);
  const auto yaw_rad = io::yaw_rad_of_quaternion(at.qx, at.qy, at.qz, at.qw);
  if (!yaw_rad)
    return refused("its quaternion is of length zero or not finite", "for no turn write 0, 0, 0, 1");
  const double xx = pose.covariance[0];
  const double yy = pose.covariance[7];
  const double aa = pose.covariance[35];
  if (auto refusal = refuse_covariance(xx, pose.covariance[1], yy, aa)) return *refusal;
  StartGuess guess{{at.x_m, at.y_m, wrap_angle(*yaw_rad)}, std::nullopt};
  const double sigma_m = std::sqrt(std::max({xx, yy, 0.0}));
  if (sigma_m > kStartAt_m || aa > kStartAt_rad * kStartAt_rad)
    guess.within = SearchRegion{{at.x_m, at.y_m}, std::max(kSearched_sigma * sigma_m, kLeastRadius_m)};
  return guess;
}

Result<Done> check_on_map(const StartGuess& guess, const Map& map) {
  const Eigen::AlignedBox2d box = wall_box(map);
  const Pose2& at = guess.map_from_base;
  const double off_m = box.isEmpty() ? 0.0 : box.exteriorDistance(Eigen::Vector2d(at.x_m, at.y_m));
  // A search looks for places between the walls only; who is sure may stand in the yard before them.
  if (off_m <= (guess.within ? guess.within->radius_m : kFurthestSight_m)) return Done{};
  return refused(
      fmt::format(
          "x {:.1f} m, y {:.1f} m lies {:.0f} m off the map, whose walls are between {:.1f}, {:.1f} and "
          "{:.1f}, {:.1f}",
          at.x_m, at.y_m, off_m, box.min().x(), box.min().y(), box.max().x(), box.max().y()),
      "give a place on the map");
}

}  // namespace beaconless::ros1
