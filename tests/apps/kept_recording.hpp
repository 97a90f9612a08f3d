// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "beaconless/io/recording.hpp"

namespace beaconless {

/// A recording of events that are in memory.
inline io::Recording recording_of(std::vector<Event> events) {
  class Stream final : public io::EventStream {
   public:
    explicit Stream(std::shared_ptr<const std::vector<Event>> events) : events_(std::move(events)) {}
    std::optional<Event> next() override {
      if (at_ >= events_->size()) return std::nullopt;
      return (*events_)[at_++];
    }

   private:
    std::shared_ptr<const std::vector<Event>> events_;
    std::size_t at_ = 0;
  };
  const auto kept = std::make_shared<const std::vector<Event>>(std::move(events));
  return {"kept", "kept", "SCAN", {}, [kept] { return std::make_unique<Stream>(kept); }};
}

/// A sweep of three beams at a time.
inline Scan scan_at(double seconds_s) {
  RawScan raw;
  raw.stamp = Stamp::from_seconds(seconds_s);
  raw.angle_min_rad = -0.1F;
  raw.angle_increment_rad = 0.1F;
  raw.range_min_m = 0.1F;
  raw.range_max_m = 30.0F;
  raw.ranges_m = {1.0F, 2.0F, 3.0F};
  return Scan::make(raw).value();
}

/// Scans at 0, 1, 2 … s, and odometry half a second after each.
inline std::vector<Event> drive_of(std::size_t scans) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < scans; ++i) {
    const auto at_s = static_cast<double>(i);
    events.emplace_back(scan_at(at_s));
    events.emplace_back(Odometry{Stamp::from_seconds(at_s + 0.5), Pose2{0.1 * at_s, 0.0, 0.0}, {}, "ODOM"});
  }
  return events;
}

}  // namespace beaconless
