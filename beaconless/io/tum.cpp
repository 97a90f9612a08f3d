// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/tum.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/quaternion_yaw.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr double kMaxCoordinate_m = 1e9;

/// The pose of a line, or what is wrong with it.
struct TumLine {
  std::optional<StampedPose> pose;
  std::string what;
};

TumLine pose_of(const std::vector<std::string_view>& words) {
  if (words.size() != 8) return {{}, "there are " + std::to_string(words.size()) + " words, a pose has 8"};
  const auto stamp = parse_stamp(words[0]);
  if (!stamp) return {{}, "\"" + shown(words[0]) + "\" is not a time in seconds"};
  std::array<double, 7> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parse_double(words[i + 1]);
    if (!number || !std::isfinite(*number))
      return {{}, "\"" + shown(words[i + 1]) + "\" is not a finite number"};
    numbers[i] = *number;
  }
  const auto [x, y, z, qx, qy, qz, qw] = numbers;
  if (std::abs(x) > kMaxCoordinate_m || std::abs(y) > kMaxCoordinate_m)
    return {{}, "the position is beyond 1e9 m"};
  const auto yaw_rad = yaw_rad_of_quaternion(qx, qy, qz, qw);
  if (!yaw_rad) return {{}, "the quaternion has no length"};
  return {StampedPose{*stamp, Pose2{x, y, wrap_angle(*yaw_rad)}}, {}};
}

std::string line_of(Stamp stamp, const Pose2& pose) {
  return fmt::format("{} {:.9f} {:.9f} 0 0 0 {:.9f} {:.9f}\n", to_string(stamp), pose.x_m, pose.y_m,
                     std::sin(pose.theta_rad / 2.0), std::cos(pose.theta_rad / 2.0));
}

}  // namespace

Result<Trajectory> read_tum(const std::string& path, const std::function<void(const Problem&)>& on_problem) {
  auto text = read_text_table(path);
  if (!text) return text.error();
  std::vector<StampedPose> poses;
  for_each_row(*text, [&](std::size_t line, std::string_view row) {
    TumLine read = pose_of(split_words(row));
    if (read.pose && !poses.empty() && read.pose->stamp < poses.back().stamp)
      read.what = "the stamp is older than the one before; the pose is put where it belongs";
    if (read.pose) poses.push_back(*read.pose);
    if (!read.what.empty() && on_problem) on_problem({path + ":" + std::to_string(line), read.what});
  });
  if (poses.empty())
    return Error{path, "holds no pose", "a TUM line is: t x y z qx qy qz qw, separated by blanks"};
  return Trajectory(std::move(poses));
}

Result<Done> write_tum(const std::string& path, const Trajectory& trajectory) {
  TumWriter writer(path);
  for (const StampedPose& stamped : trajectory) writer.write(stamped.stamp, stamped.pose);
  return writer.finish();
}

TumWriter::TumWriter(const std::string& path) : path_(path), out_(path, std::ios::binary | std::ios::trunc) {}

void TumWriter::write(Stamp stamp, const Pose2& pose) { out_ << line_of(stamp, pose); }

Result<Done> TumWriter::finish() {
  out_.close();
  if (!out_) return Error{path_, "cannot be written", "is there such a folder, and room in it?"};
  return Done{};
}

}  // namespace beaconless::io
