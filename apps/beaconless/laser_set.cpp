// SPDX-License-Identifier: Apache-2.0
#include "laser_set.hpp"

#include "beaconless/io/merged_recording.hpp"

namespace beaconless::cli {
namespace {

Result<std::string> frame_of(const io::Recording& recording) {
  for (const Event& event : recording)
    if (const auto* scan = std::get_if<Scan>(&event)) return scan->frame_id();
  return Error{recording.path(), "there is no scan under " + recording.scan_topic(),
               "leave this --topic out"};
}

Result<Pose2> place_of(const io::Recording& recording, const std::vector<std::string>& places,
                       std::size_t laser) {
  if (!places.empty()) return pose_from_words("--base-from-laser", places[laser]);
  if (const auto& told = recording.laser_place()) return told->base_from_laser;
  return Error{"--base-from-laser",
               recording.path() + " does not tell where the laser of " + recording.scan_topic() + " sits",
               "give one for each --topic, in their order"};
}

}  // namespace

void LaserWords::settle_one(std::string& topic, std::string& place) const {
  if (are_several()) return;
  if (!topics.empty()) topic = topics.front();
  if (!places.empty()) place = places.front();
}

Result<LaserSet> open_lasers(const std::string& path, const ScanWords& words, const LaserWords& told,
                             ProblemLog& problems) {
  const auto& [topics, places] = told;
  if (!places.empty() && places.size() != topics.size())
    return Error{"--base-from-laser",
                 "there are " + std::to_string(topics.size()) + " lasers and " +
                     std::to_string(places.size()) + " places",
                 "give one for each --topic, in their order"};
  const auto scans = words.selection();
  if (!scans) return scans.error();
  std::vector<io::Recording> recordings;
  std::vector<LaserOnRobot> lasers;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    ScanWords of_one = words;
    of_one.topic = topics[i];
    auto recording = open_recording(path, of_one, problems);
    if (!recording) return recording.error();
    auto frame = frame_of(*recording);
    if (!frame) return frame.error();
    const auto place = place_of(*recording, places, i);
    if (!place) return place.error();
    if (frame->empty())
      return Error{
          path, "scans of " + topics[i] + " tell no frame, by which those of several lasers are told apart",
          "several lasers need a bag or an MCAP file with frames"};
    for (const LaserOnRobot& other : lasers)
      if (other.frame_id == *frame)
        return Error{path, topics[i] + " has the frame \"" + *frame + "\" of another of the lasers",
                     "scans are told apart by their frames: give each driver one of its own"};
    lasers.push_back({*std::move(frame), *place});
    recordings.push_back(*std::move(recording));
  }
  return LaserSet{merge_recordings(std::move(recordings), *scans), std::move(lasers)};
}

}  // namespace beaconless::cli
