// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/merged_recording.hpp"

#include <utility>

namespace beaconless::io {
namespace {

using OnProblem = std::function<void(const Problem&)>;

/// The selected scans of one of them; other events only where they are wanted.
class OneOfMany {
 public:
  OneOfMany(const LaserRecording& laser, const ScanSelection& scans, bool with_others, OnProblem on_problem)
      : path_(laser.recording.path()),
        topic_(laser.recording.scan_topic()),
        frame_id_(laser.frame_id),
        events_(laser.recording.open_pass()),
        scans_(scans),
        with_others_(with_others),
        on_problem_(std::move(on_problem)) {
    step();
  }

  const std::optional<Event>& head() const { return head_; }
  std::uint64_t skipped() const { return events_->skipped(); }
  std::uint64_t strange() const { return strange_; }

  std::optional<Event> take() {
    auto event = std::move(head_);
    step();
    return event;
  }

 private:
  void step() {
    while ((head_ = events_->next())) {
      const auto* scan = std::get_if<Scan>(&*head_);
      if (scan == nullptr) {
        if (with_others_) return;
      } else if (scan->frame_id() != frame_id_) {
        pass_over(*scan);
      } else if (const std::size_t index = next_scan_++; scans_.wants(index)) {
        return;
      }
    }
  }

  void pass_over(const Scan& scan) {
    ++strange_;
    if (on_problem_)
      on_problem_({path_, "a scan of " + topic_ + " at " + to_string(scan.stamp()) + " has the frame \"" +
                              scan.frame_id() + "\", the others have \"" + frame_id_ +
                              "\", by which lasers are told apart; it is passed over"});
  }

  std::string path_;
  std::string topic_;
  std::string frame_id_;
  std::unique_ptr<EventStream> events_;
  ScanSelection scans_;
  bool with_others_;
  OnProblem on_problem_;
  std::size_t next_scan_ = 0;
  std::uint64_t strange_ = 0;
  std::optional<Event> head_;
};

class MergedStream : public EventStream {
 public:
  MergedStream(const std::vector<LaserRecording>& lasers, const ScanSelection& scans,
               const OnProblem& on_problem) {
    for (const LaserRecording& laser : lasers)
      streams_.emplace_back(laser, scans, streams_.empty(), on_problem);
  }

  std::optional<Event> next() override {
    OneOfMany* earliest = nullptr;
    for (OneOfMany& stream : streams_)
      if (stream.head() && (earliest == nullptr || stamp_of(*stream.head()) < stamp_of(*earliest->head())))
        earliest = &stream;
    return earliest == nullptr ? std::nullopt : earliest->take();
  }

  std::uint64_t skipped() const override {
    std::uint64_t count = streams_.front().skipped();
    for (const OneOfMany& stream : streams_) count += stream.strange();
    return count;
  }

 private:
  std::vector<OneOfMany> streams_;
};

}  // namespace

Recording merge_recordings(std::vector<LaserRecording> lasers, const ScanSelection& scans,
                           std::function<void(const Problem&)> on_problem) {
  std::string scan_topics;
  for (const LaserRecording& laser : lasers)
    scan_topics += (scan_topics.empty() ? "" : ", ") + laser.recording.scan_topic();
  const Recording first = lasers.front().recording;
  return {first.path(), first.format(), scan_topics, first.topics(),
          [lasers = std::move(lasers), scans, on_problem = std::move(on_problem)] {
            return std::make_unique<MergedStream>(lasers, scans, on_problem);
          }};
}

}  // namespace beaconless::io
