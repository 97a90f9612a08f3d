// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"

namespace beaconless::io {

/// A record that was passed over, or a habit of the file the reader should know of. Reading goes on.
struct Problem {
  std::string where;  ///< path with line or byte
  std::string what;

  friend bool operator==(const Problem&, const Problem&) = default;
};

/// How to open a recording.
struct RecordingOptions {
  std::string topic;  ///< the scans to take: a topic of a bag, a keyword of a log; empty: the only one
  bool scans_optional = false;  ///< where there are several and none is chosen, read none instead of refusing
  ScanGate gate;                ///< what Scan::make may assume
  std::function<void(const Problem&)> on_problem;  ///< called for each problem, on every pass; may be empty
};

/// One source of events inside a recording.
struct Topic {
  std::string name;         ///< a topic of a bag, a keyword of a log
  std::string type;         ///< "sensor_msgs/LaserScan", or for a log line "scan", "odometry", "pose"
  std::uint64_t count = 0;  ///< messages, as far as the file tells without reading all of it

  friend bool operator==(const Topic&, const Topic&) = default;
};

/// Where a recording says that its laser sits on the robot.
struct LaserPlace {
  Pose2 base_from_laser;
  std::string told_by;     ///< "/tf_static, base_link -> rplidar_link"
  std::string base_frame;  ///< "base_link"; empty where frames have no names

  friend bool operator==(const LaserPlace&, const LaserPlace&) = default;
};

/// A file's events in the order of the file, one at a time.
class EventStream {
 public:
  virtual ~EventStream() = default;

  /// The next event; nothing at the end.
  virtual std::optional<Event> next() = 0;

  /// How many records this pass had to pass over so far.
  virtual std::uint64_t skipped() const { return 0; }
};

/// A recording of a robot: a description of the file, and an iterable of its events.
///
/// Each `begin()` starts a new pass over the file and reads as it goes, so that memory does not grow with the
/// file. Copies are cheap and share nothing that changes.
class Recording {
 public:
  using Opener = std::function<std::unique_ptr<EventStream>()>;

  Recording(std::string path, std::string format, std::string scan_topic, std::vector<Topic> topics,
            Opener open_pass)
      : path_(std::move(path)),
        format_(std::move(format)),
        scan_topic_(std::move(scan_topic)),
        topics_(std::move(topics)),
        open_pass_(std::move(open_pass)) {}

  const std::string& path() const { return path_; }
  const std::string& format() const { return format_; }  ///< "CARMEN log", "ROS 1 bag 2.0", …
  const std::string& scan_topic() const {
    return scan_topic_;
  }  ///< the one that is read; empty when there is none
  const std::vector<Topic>& topics() const { return topics_; }  ///< all that were found, also those not read

  /// For the scans that are read; nothing where the recording does not tell it once and for all.
  const std::optional<LaserPlace>& laser_place() const { return laser_place_; }
  void set_laser_place(LaserPlace place) { laser_place_ = std::move(place); }

  /// A new pass, for those who want to pull events themselves.
  std::unique_ptr<EventStream> open_pass() const { return open_pass_(); }

  class Iterator {
   public:
    using value_type = Event;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    explicit Iterator(std::unique_ptr<EventStream> stream) : stream_(std::move(stream)) { ++*this; }

    const Event& operator*() const { return *event_; }
    const Event* operator->() const { return &*event_; }
    Iterator& operator++() {
      event_ = stream_->next();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& it, std::default_sentinel_t) { return !it.event_.has_value(); }

   private:
    std::shared_ptr<EventStream> stream_;
    std::optional<Event> event_;
  };

  Iterator begin() const { return Iterator(open_pass_()); }
  std::default_sentinel_t end() const { return {}; }

 private:
  std::string path_;
  std::string format_;
  std::string scan_topic_;
  std::vector<Topic> topics_;
  std::optional<LaserPlace> laser_place_;
  Opener open_pass_;
};

/// Opens a recording of any known format; the content decides, not the name.
///
/// Errors (with path, line or byte, reason and what to do): no such file, empty, unknown format, a format
/// this build cannot read, a topic that is not there (all are listed), several scan topics and none chosen
/// (all are listed).
Result<Recording> open_recording(const std::string& path, const RecordingOptions& options = {});

}  // namespace beaconless::io
