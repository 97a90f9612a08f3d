// SPDX-License-Identifier: Apache-2.0
#include "resume.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/last_pose.hpp"

namespace beaconless::cli {
namespace {

constexpr double kOld_s = 3600.0;

std::string age_words(double age_s) {
  const double size_s = std::abs(age_s);
  return size_s < 2.0 * 86400.0 ? fmt::format("{:.1f} hours", size_s / 3600.0)
                                : fmt::format("{:.0f} days", size_s / 86400.0);
}

}  // namespace

Result<Pose2> resumed_pose(const Console& console, const std::string& pose_file, const io::MapIdentity& map,
                           Stamp first_scan) {
  const auto last = io::read_last_pose(pose_file);
  if (!last) return last.error();
  if (auto fits = io::check_map(*last, pose_file, map); !fits) return fits.error();
  const double age_s = seconds_between(last->stamp, first_scan);
  if (std::abs(age_s) > kOld_s)
    console.warn(fmt::format("{}: the pose is {} {} than the first scan; it is taken if that fits there",
                             pose_file, age_words(age_s), age_s > 0.0 ? "older" : "newer"));
  return last->map_from_base;
}

}  // namespace beaconless::cli
