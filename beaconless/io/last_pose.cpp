// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/last_pose.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/atomic_file.hpp"
#include "beaconless/io/whole_file.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {
namespace {

constexpr std::uint64_t kLongest_bytes = 1U << 16U;
constexpr std::string_view kChecksum = "checksum: ";
constexpr std::array kStatuses{Status::ok, Status::degraded, Status::lost, Status::relocalizing};
/// The upper triangle of the covariance, in the order of estimates.csv.
constexpr std::array<std::pair<int, int>, 6> kUpper{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

const std::string kRemedy = "start by --start x,y,deg, auto or near:x,y,radius instead";

/// The lines that the checksum is of.
std::string body_of(const LastPose& pose) {
  std::string covariance;
  for (const auto& [row, column] : kUpper)
    covariance += (covariance.empty() ? "" : ", ") + yaml_number(pose.covariance(row, column));
  const Pose2& at = pose.map_from_base;
  return fmt::format(
      "# Where the robot was last: metres and radians in the frame of the map.\n"
      "stamp: {}\nx_m: {}\ny_m: {}\ntheta_rad: {}\ncovariance: [{}]  # xx, xy, xtheta, yy, ytheta, "
      "thetatheta\nstatus: {}\nquality: {}\nmap: {}\nmap_hash: {}\n",
      to_string(pose.stamp), yaml_number(at.x_m), yaml_number(at.y_m), yaml_number(at.theta_rad), covariance,
      to_string(pose.status), yaml_number(pose.quality), yaml_text(pose.map.name), hash_text(pose.map.hash));
}

/// The bytes of a file that is the one that was written.
Result<std::string> read_as_written(const std::string& path) {
  auto text = read_whole_file(path, kLongest_bytes);
  if (!text) return Error{text.error().where, text.error().what, kRemedy};
  if (text->empty()) return Error{path, "the file is empty", kRemedy};
  const auto at = text->rfind(kChecksum);
  if (at == std::string::npos) return Error{path, "the file is cut short: its last line is missing", kRemedy};
  if (text->substr(at) != fmt::format("{}{}\n", kChecksum, hash_text(fnv1a(text->substr(0, at)))))
    return Error{path, "the file is cut short or was edited: its checksum is another", kRemedy};
  return text;
}

/// The values of a file, one after the other, and the first that is wrong.
class Values {
 public:
  Values(const std::string& path, const YamlNode& yaml) : path_(path), yaml_(yaml) {}

  std::string text(std::string_view key) {
    const YamlNode* node = yaml_.find(key);
    if (node != nullptr && node->kind == YamlNode::Kind::scalar) return node->text;
    wrong(key, node);
    return "";
  }
  double number(std::string_view key) {
    const YamlNode* node = yaml_.find(key);
    if (node != nullptr) return number(key, *node);
    wrong(key, node);
    return 0.0;
  }
  double number(std::string_view key, const YamlNode& node) {
    const auto number = node.number();
    if (!number) wrong(key, &node);
    return number.value_or(0.0);
  }
  const YamlNode* list(std::string_view key, std::size_t size) {
    const YamlNode* node = yaml_.find(key);
    if (node != nullptr && node->kind == YamlNode::Kind::list && node->size() == size) return node;
    wrong(key, node);
    return nullptr;
  }
  void wrong(std::string_view key, const YamlNode* node) {
    if (error_) return;
    error_ = node == nullptr
                 ? Error{path_, fmt::format("there is no {}", key), kRemedy}
                 : Error{where_in(path_, *node), fmt::format("{} is {}", key, node->described()), kRemedy};
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  const std::string& path_;
  const YamlNode& yaml_;
  std::optional<Error> error_;
};

std::optional<std::uint64_t> hash_of(std::string_view text) {
  constexpr std::string_view kKind = "fnv1a-";
  if (!text.starts_with(kKind) || text.size() != kKind.size() + 16) return std::nullopt;
  std::uint64_t hash = 0;
  const auto [end, failed] = std::from_chars(text.data() + kKind.size(), text.data() + text.size(), hash, 16);
  if (failed != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return hash;
}

}  // namespace

LastPose last_pose_of(const PoseEstimate& estimate, const MapIdentity& map) {
  return {estimate.stamp,  estimate.map_from_base, estimate.covariance,
          estimate.status, estimate.quality,       map};
}

Result<Done> write_last_pose(const std::string& path, const LastPose& pose) {
  const std::string body = body_of(pose);
  return write_file_atomically(path, fmt::format("{}{}{}\n", body, kChecksum, hash_text(fnv1a(body))));
}

Result<LastPose> read_last_pose(const std::string& path) {
  auto text = read_as_written(path);
  if (!text) return text.error();
  const auto yaml = parse_yaml(path, *std::move(text));
  if (!yaml) return yaml.error();
  Values values(path, *yaml);
  LastPose pose;
  // 1. Where it was, and when.
  const auto stamp = parse_stamp(values.text("stamp"));
  if (!stamp) values.wrong("stamp", yaml->find("stamp"));
  pose.stamp = stamp.value_or(Stamp{});
  pose.map_from_base = {values.number("x_m"), values.number("y_m"), wrap_angle(values.number("theta_rad"))};
  // 2. How good that was.
  if (const YamlNode* upper = values.list("covariance", kUpper.size()))
    for (std::size_t i = 0; i < kUpper.size(); ++i) {
      const auto& [row, column] = kUpper[i];
      pose.covariance(row, column) = pose.covariance(column, row) =
          values.number("covariance", upper->items[i]);
    }
  const std::string status = values.text("status");
  const auto* known =
      std::find_if(kStatuses.begin(), kStatuses.end(), [&](Status s) { return to_string(s) == status; });
  if (known == kStatuses.end()) values.wrong("status", yaml->find("status"));
  pose.status = known == kStatuses.end() ? Status::lost : *known;
  pose.quality = values.number("quality");
  // 3. On which map.
  pose.map.name = values.text("map");
  const auto hash = hash_of(values.text("map_hash"));
  if (!hash) values.wrong("map_hash", yaml->find("map_hash"));
  pose.map.hash = hash.value_or(0);
  if (values.error()) return *values.error();
  return pose;
}

Result<Done> check_map(const LastPose& pose, const std::string& path, const MapIdentity& map) {
  if (pose.map.hash == map.hash) return Done{};
  if (pose.map.name == map.name)
    return Error{path, "the pose is of an older state of " + map.name + ": the map has changed since",
                 kRemedy};
  return Error{path, "the pose is one on the map " + pose.map.name + ", not on " + map.name,
               "give that map, or " + kRemedy};
}

}  // namespace beaconless::io
