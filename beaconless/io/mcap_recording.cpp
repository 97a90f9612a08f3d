// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_recording.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "beaconless/io/mcap_messages.hpp"
#include "beaconless/io/mcap_survey.hpp"
#include "beaconless/io/ros_events.hpp"
#include "beaconless/io/told_laser.hpp"
#include "beaconless/io/topic_choice.hpp"

namespace beaconless::io {
namespace {

/// How the messages of a channel are to be understood.
struct Channel {
  std::string topic;
  std::string type;
  bool is_cdr = false;
};

using Channels = std::map<std::uint16_t, Channel>;

/// The messages of some channels, one pass.
class McapSource : public RosMessageSource {
 public:
  McapSource(const std::string& path, const std::shared_ptr<const McapSurvey>& survey, Channels channels,
             const std::function<void(const Problem&)>& on_problem)
      : messages_(path, survey, ids_of(channels), on_problem), channels_(std::move(channels)) {
    if (on_problem)
      for (const Problem& problem : survey->problems) on_problem(problem);
  }

  Step next(RosMessage& message) override {
    McapMessage view;
    if (!messages_.next(view)) return Step::end;
    const Channel& channel = channels_.at(view.channel_id);
    message = {channel.topic, channel.type, channel.is_cdr, static_cast<std::int64_t>(view.log_ns), {}};
    message.bytes.assign(view.data.begin(), view.data.end());
    return Step::message;
  }

  std::uint64_t skipped() const { return messages_.skipped(); }

 private:
  static std::set<std::uint16_t> ids_of(const Channels& channels) {
    std::set<std::uint16_t> ids;
    for (const auto& [id, channel] : channels) ids.insert(id);
    return ids;
  }

  McapMessages messages_;
  Channels channels_;
};

/// The events of a pass, which also counts the chunks and records that were passed over.
class McapStream : public EventStream {
 public:
  McapStream(const std::string& path, std::unique_ptr<McapSource> source, const RecordingOptions& options)
      : source_(*source), events_(ros_events(path, std::move(source), options)) {}

  std::optional<Event> next() override { return events_->next(); }
  std::uint64_t skipped() const override { return events_->skipped() + source_.skipped(); }

 private:
  const McapSource& source_;  ///< lives in events_
  std::unique_ptr<EventStream> events_;
};

/// What is left of a survey without the chunks that hold none of these channels, as their indexes say.
std::shared_ptr<const McapSurvey> parts_of(const McapSurvey& survey, const Channels& channels) {
  auto some = std::make_shared<McapSurvey>(survey);
  std::erase_if(some->parts, [&](const McapPart& part) {
    return part.is_chunk && !part.channels.empty() &&
           std::none_of(channels.begin(), channels.end(),
                        [&](const auto& channel) { return part.channels.contains(channel.first); });
  });
  return some;
}

/// Several publishers of a topic are several channels.
void add(std::vector<Topic>& topics, const Topic& topic) {
  for (Topic& known : topics)
    if (known.name == topic.name && known.type == topic.type) {
      known.count += topic.count;
      return;
    }
  topics.push_back(topic);
}

}  // namespace

Result<Recording> open_mcap(const std::string& path, const RecordingOptions& options) {
  auto surveyed = survey_mcap(path);
  if (!surveyed) return surveyed.error();
  const auto survey = std::make_shared<const McapSurvey>(std::move(surveyed).value());
  std::vector<Topic> topics;
  std::vector<Topic> scan_topics;
  std::string not_read;
  Channels channels;
  for (const auto& [id, channel] : survey->channels) {
    const auto schema = survey->schemas.find(channel.schema_id);
    const std::string type = schema == survey->schemas.end() ? "" : schema->second.name;
    const auto count = survey->messages.find(id);
    const Topic topic{channel.topic, type, count == survey->messages.end() ? 0 : count->second};
    add(topics, topic);
    const std::string& encoding = channel.message_encoding;
    const bool is_read = encoding == "cdr" || encoding == "ros1";
    if (is_laser_scan_type(type) && !is_read) not_read = encoding;
    if (is_laser_scan_type(type) && is_read) add(scan_topics, topic);
    if ((is_laser_scan_type(type) || is_pose_type(type)) && is_read)
      channels[id] = {channel.topic, type, encoding == "cdr"};
  }
  if (scan_topics.empty() && !not_read.empty())
    return Error{path, "its scans are encoded as '" + not_read + "', which is not read",
                 "read are 'cdr' (ROS 2) and 'ros1': convert it with `mcap convert`"};
  const auto chosen = choose_scan_topic(path, options, scan_topics);
  if (!chosen) return chosen.error();
  std::erase_if(channels, [&](const auto& channel) {
    return is_laser_scan_type(channel.second.type) && channel.second.topic != *chosen;
  });
  const auto open_messages = [&](const std::vector<std::string>& of) {
    Channels some;
    for (const auto& [id, channel] : channels)
      if (std::find(of.begin(), of.end(), channel.topic) != of.end()) some[id] = channel;
    return std::make_unique<McapSource>(path, parts_of(*survey, some), some, nullptr);
  };
  const ToldLaser laser = told_laser(open_messages, topics, *chosen);
  const std::string format =
      "MCAP" + (survey->header.profile.empty() ? "" : " (" + survey->header.profile + ")");
  Recording recording(
      path, format, *chosen, std::move(topics),
      [path, survey, channels, options, no_place = laser.problem]() -> std::unique_ptr<EventStream> {
        if (!no_place.empty() && options.on_problem) options.on_problem({path, no_place});
        return std::make_unique<McapStream>(
            path, std::make_unique<McapSource>(path, survey, channels, options.on_problem), options);
      });
  if (laser.place) recording.set_laser_place(*laser.place);
  return recording;
}

}  // namespace beaconless::io
