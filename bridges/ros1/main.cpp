// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <iostream>
#include <string_view>

#include "beaconless/io/map_io.hpp"

#include "bridges/ros1/node.hpp"
#include "bridges/ros1/ros_link.hpp"

namespace {

constexpr std::string_view kUsage =
    "usage: beaconless_ros1 [TOPIC:=OTHER] [_PARAMETER:=VALUE] ...\n"
    "Localizes a robot on a known map, as a ROS 1 node in the place of amcl.\n"
    "Hears scan, map, initialpose and tf; tells amcl_pose, tf, particlecloud, ~beams, ~path, /diagnostics.\n"
    "Parameters: those of `beaconless params` (points may be slashes), and those of amcl.\n"
    "Example:  beaconless_ros1 scan:=/front/scan _map_file:=hall.yaml _base_frame_id:=base_footprint\n";

/// Tells the log why the node does not start.
int refuse(beaconless::ros1::RosLink& link, const beaconless::Error& error) {
  link.log(beaconless::ros1::Level::error, to_string(error));
  return 2;
}

int run(int argc, char** argv) {
  using namespace beaconless;
  for (int i = 1; i < argc; ++i)
    if (const std::string_view word = argv[i]; word == "--help" || word == "-h") {
      std::cout << kUsage;
      return 0;
    }
  ros1::RosLink link(argc, argv, "beaconless");
  // 1. What was asked for.
  const auto settings = ros1::settings_of(link.parameters());
  if (!settings) return refuse(link, settings.error());
  for (const std::string& remark : settings->remarks) link.log(ros1::Level::warn, remark);
  ros1::Node node(*settings, link);
  // 2. The map, where it is a file.
  if (const std::string& path = settings->node.map_file; !path.empty()) {
    auto map = io::read_map(path);
    if (!map) return refuse(link, map.error());
    const auto identity = io::identify_map(path);
    if (!identity) return refuse(link, identity.error());
    if (auto set = node.set_map(*std::move(map), *identity); !set) return refuse(link, set.error());
  }
  // 3. Hear and tell.
  link.run(node.handlers(), ros1::scan_topics_of(settings->node));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "beaconless_ros1: " << error.what() << '\n';
    return 1;
  }
}
