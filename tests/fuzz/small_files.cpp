// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/last_pose.hpp"
#include "beaconless/io/map_identity.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/relations.hpp"
#include "beaconless/io/rosbag2_recording.hpp"
#include "beaconless/io/scenario_io.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/sim/scenario.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {
namespace {

void check(const OccupancyGrid& grid) {
  require(std::isfinite(grid.resolution_m) && grid.resolution_m > 0 && grid.map_from_grid.is_finite(),
          "a grid lies somewhere");
}

void check(const FloorPlan& plan) {
  for (const auto& wall : plan.walls)
    for (const auto& point : wall) require(point.allFinite(), "walls are finite");
}

void read_map_yaml(const std::string& path) {
  if (const auto identity = io::identify_map(path); !identity) fuzz::check(identity.error());
  const auto map = io::read_map(path);
  if (!map) return fuzz::check(map.error());
  std::visit([](const auto& m) { check(m); }, *map);
}

void read_scenario(const std::string& path) {
  const auto scenario = io::read_scenario(path);
  if (!scenario) return fuzz::check(scenario.error());
  check(scenario->plan);
  require(std::isfinite(scenario->duration_s) && scenario->base_from_laser.is_finite(),
          "a scenario is finite");
  require(sim::check(*scenario).ok(), "a scenario that was read can be run");
}

std::vector<std::string> texts(const std::vector<Field>& fields) {
  std::vector<std::string> texts;
  for (const Field& field : fields) texts.push_back(field.text());
  return texts;
}

void read_config(const std::string& path) {
  sim::Scenario scenario;
  const auto fields = fields_of(scenario);
  const auto before = texts(fields);
  if (const auto read = io::read_config(path, fields); !read) {
    fuzz::check(read.error());
    require(texts(fields) == before, "what cannot be read changes nothing");
  }
  for (const Field& field : fields) require(!field.check(), "a field holds what is allowed");
}

void read_estimates(const std::string& path) {
  const auto estimates = io::read_estimates_csv(path);
  if (!estimates) return fuzz::check(estimates.error());
  for (const PoseEstimate& estimate : *estimates)
    require(estimate.map_from_base.is_finite() && estimate.covariance.allFinite(), "estimates are finite");
}

void read_tum(const std::string& path) {
  const auto trajectory = io::read_tum(path);
  if (!trajectory) fuzz::check(trajectory.error());
}

void read_relations(const std::string& path) {
  const auto relations = io::read_relations(path);
  if (!relations) return fuzz::check(relations.error());
  for (const PoseRelation& relation : *relations)
    require(relation.from_pose_to.is_finite(), "relations are finite");
}

void read_last_pose(const std::string& path) {
  const auto pose = io::read_last_pose(path);
  if (!pose) return fuzz::check(pose.error());
  require(pose->map_from_base.is_finite() && pose->covariance.allFinite() && pose->quality >= 0 &&
              pose->quality <= 1,
          "a last pose is finite");
}

/// The folder of a ROS 2 bag, of which only the metadata.yaml is there.
void read_bag_folder(const std::string& path) {
  const auto recording = io::open_rosbag2(std::filesystem::path(path).parent_path().string());
  if (!recording) fuzz::check(recording.error());
}

}  // namespace

void read_small_files(Bytes bytes) {
  if (bytes.empty()) return;
  static const InputFolder folder;
  constexpr unsigned kKinds = 8;
  const unsigned kind = bytes[0] % kKinds;
  const std::string path = folder.write(kind == 7 ? "metadata.yaml" : "input", bytes.subspan(1));
  using Read = void (*)(const std::string&);
  constexpr Read kReaders[kKinds] = {read_map_yaml, read_scenario,  read_config,    read_estimates,
                                     read_tum,      read_relations, read_last_pose, read_bag_folder};
  kReaders[kind](path);
}

}  // namespace beaconless::fuzz
