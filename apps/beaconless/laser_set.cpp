// SPDX-License-Identifier: Apache-2.0
#include "laser_set.hpp"

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

Result<std::vector<io::LaserRecording>> open_each(const std::string& path, const ScanWords& words,
                                                  const std::vector<std::string>& topics,
                                                  ProblemLog& problems) {
  std::vector<io::LaserRecording> lasers;
  for (const std::string& topic : topics) {
    ScanWords of_one = words;
    of_one.topic = topic;
    auto recording = open_recording(path, of_one, problems);
    if (!recording) return recording.error();
    for (const io::LaserRecording& other : lasers)
      if (other.recording.scan_topic() == recording->scan_topic())
        return Error{"--topic", recording->scan_topic() + " is named twice", "name each laser once"};
    auto frame = frame_of(*recording);
    if (!frame) return frame.error();
    if (frame->empty())
      return Error{path,
                   "scans of " + topic + " tell no frame, by which those of several lasers are told apart",
                   "several lasers need a bag or an MCAP file with frames"};
    for (const io::LaserRecording& other : lasers)
      if (other.frame_id == *frame)
        return Error{path, topic + " has the frame \"" + *frame + "\" of another of the lasers",
                     "scans are told apart by their frames: give each driver one of its own"};
    lasers.push_back({*std::move(recording), *std::move(frame)});
  }
  return lasers;
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
  auto each = open_each(path, words, topics, problems);
  if (!each) return each.error();
  std::vector<LaserOnRobot> lasers;
  for (std::size_t i = 0; i < each->size(); ++i) {
    const io::LaserRecording& laser = (*each)[i];
    const auto place = place_of(laser.recording, places, i);
    if (!place) return place.error();
    lasers.push_back({laser.frame_id, *place});
  }
  return LaserSet{io::merge_recordings(*std::move(each), *scans,
                                       [&problems](const io::Problem& problem) { problems.add(problem); }),
                  std::move(lasers)};
}

}  // namespace beaconless::cli
