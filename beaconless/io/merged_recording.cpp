// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/merged_recording.hpp"

#include <utility>

namespace beaconless::io {
namespace {

/// The selected scans of one of them; other events only where they are wanted.
class OneOfMany {
 public:
  OneOfMany(std::unique_ptr<EventStream> events, const ScanSelection& scans, bool with_others)
      : events_(std::move(events)), scans_(scans), with_others_(with_others) {
    step();
  }

  const std::optional<Event>& head() const { return head_; }
  std::uint64_t skipped() const { return events_->skipped(); }

  std::optional<Event> take() {
    auto event = std::move(head_);
    step();
    return event;
  }

 private:
  void step() {
    while ((head_ = events_->next())) {
      if (!std::holds_alternative<Scan>(*head_)) {
        if (with_others_) return;
      } else if (const std::size_t index = next_scan_++; scans_.wants(index)) {
        return;
      }
    }
  }

  std::unique_ptr<EventStream> events_;
  ScanSelection scans_;
  bool with_others_;
  std::size_t next_scan_ = 0;
  std::optional<Event> head_;
};

class MergedStream : public EventStream {
 public:
  MergedStream(const std::vector<Recording>& recordings, const ScanSelection& scans) {
    for (const Recording& recording : recordings)
      streams_.emplace_back(recording.open_pass(), scans, streams_.empty());
  }

  std::optional<Event> next() override {
    OneOfMany* earliest = nullptr;
    for (OneOfMany& stream : streams_)
      if (stream.head() && (earliest == nullptr || stamp_of(*stream.head()) < stamp_of(*earliest->head())))
        earliest = &stream;
    return earliest == nullptr ? std::nullopt : earliest->take();
  }

  std::uint64_t skipped() const override { return streams_.front().skipped(); }

 private:
  std::vector<OneOfMany> streams_;
};

}  // namespace

Recording merge_recordings(std::vector<Recording> recordings, const ScanSelection& scans) {
  std::string scan_topics;
  for (const Recording& recording : recordings)
    scan_topics += (scan_topics.empty() ? "" : ", ") + recording.scan_topic();
  const Recording first = recordings.front();
  return {first.path(), first.format(), scan_topics, first.topics(),
          [recordings = std::move(recordings), scans] {
            return std::make_unique<MergedStream>(recordings, scans);
          }};
}

}  // namespace beaconless::io
