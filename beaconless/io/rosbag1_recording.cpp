// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_recording.hpp"

#ifndef BEACONLESS_HAS_ROSBAG1

namespace beaconless::io {

Result<Recording> open_rosbag1(const std::string& path, const RecordingOptions&) {
  return Error{path, "is a ROS 1 bag, and this program was built without reading them",
               "install librosbag-storage-dev and build again"};
}

}  // namespace beaconless::io

#else

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "beaconless/io/failed_pass.hpp"
#include "beaconless/io/ros_events.hpp"
#include "beaconless/io/rosbag1_bag.hpp"
#include "beaconless/io/told_laser.hpp"
#include "beaconless/io/topic_choice.hpp"

namespace beaconless::io {
namespace {

/// Formats other than 2.0 by the name that they give themselves in their first line.
std::optional<Error> refuse_version(const std::string& path) {
  std::string version(32, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(version.data(), static_cast<std::streamsize>(version.size()));
  version.resize(static_cast<std::size_t>(in.gcount()));
  version.resize(std::min(version.find('\n'), version.size()));
  if (version == "#ROSBAG V2.0") return std::nullopt;
  std::string name;
  for (const char c : version) name += c >= ' ' && c <= '~' ? c : '?';
  return Error{path, "is a bag of the format '" + name + "'; only '#ROSBAG V2.0' is read",
               "bring a copy up to date with `rosbag fix old.bag new.bag`"};
}

}  // namespace

Result<Recording> open_rosbag1(const std::string& path, const RecordingOptions& options) {
  if (auto error = refuse_version(path)) return *error;
  BagSurvey survey = survey_rosbag1(path);
  if (survey.failure)
    return Error{path + "@" + std::to_string(survey.failure->byte), survey.failure->what,
                 survey.failure->remedy};
  std::vector<Topic> topics;
  std::vector<Topic> scan_topics;
  std::vector<std::string> read_topics;
  for (const BagTopic& topic : survey.topics) {
    topics.push_back({topic.name, topic.type, topic.count});
    if (is_laser_scan_type(topic.type)) scan_topics.push_back(topics.back());
    if (is_pose_type(topic.type)) read_topics.push_back(topic.name);
  }
  const auto chosen = choose_scan_topic(path, options, scan_topics);
  if (!chosen) return chosen.error();
  if (!chosen->empty()) read_topics.push_back(*chosen);
  const auto open_bag = [path, broken = std::move(survey.broken)](const std::vector<std::string>& of) {
    return std::make_unique<Rosbag1Bag>(path, of, broken);
  };
  if (const auto tried = open_bag(read_topics); !tried->failure().empty())
    return Error{path, tried->failure(), ""};
  const ToldLaser laser = told_laser(open_bag, topics, *chosen);
  Recording recording(
      path, "ROS 1 bag 2.0", *chosen, std::move(topics),
      [path, open_bag, read_topics, options, no_place = laser.problem]() -> std::unique_ptr<EventStream> {
        auto bag = open_bag(read_topics);
        if (!bag->failure().empty()) return failed_pass(Error{path, bag->failure(), ""}, options.on_problem);
        if (!no_place.empty() && options.on_problem) options.on_problem({path, no_place});
        return ros_events(path, std::move(bag), options);
      });
  if (laser.place) recording.set_laser_place(*laser.place);
  return recording;
}

}  // namespace beaconless::io

#endif
