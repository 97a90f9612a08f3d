// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// How many events of a source a format had no room for.
struct LeftOut {
  std::uint64_t odometry = 0;
  std::uint64_t poses = 0;

  friend bool operator==(const LeftOut&, const LeftOut&) = default;
};

/// One of several lasers whose scans are written.
struct WrittenLaser {
  std::string topic;
  std::optional<LaserPlace> place;
};

/// How to write a recording.
struct RecordingWriterOptions {
  std::string scan_topic;   ///< where the format has topics; no topic: /scan
  std::string compression;  ///< of chunks: MCAP zstd, lz4, none; ROS 1 bags lz4, bz2, none; empty: the first
  std::optional<LaserPlace> laser_place;  ///< of these scans; without it the first that a ReferencePose tells
  std::map<std::string, WrittenLaser> lasers;  ///< by the frames of their scans, where there are several
};

/// Writes the events of a recording, whatever the format.
class RecordingWriter {
 public:
  RecordingWriter() = default;
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  virtual ~RecordingWriter() = default;

  virtual void write(const Event& event) = 0;
  virtual bool good() const = 0;

  /// Writes what is left, gives the file its name, and says whether all of it has reached the disk. Without
  /// this nothing is left behind.
  virtual Result<Done> finish() = 0;

  /// What the format had no room for, by its source.
  virtual std::map<std::string, LeftOut> left_out() const { return {}; }
};

/// Whether a recording of this name and with these options could be written, without touching anything.
///
/// Errors: an end that no format has, with all that are known; a compression that the format does not have;
/// several lasers in a CARMEN log.
Result<Done> can_write_recording(const std::string& path, const RecordingWriterOptions& options);

/// Opens a recording to be written; the end of its name decides: ".mcap"; ".db3", or for a folder "/" (ROS 2
/// bag); ".bag" (ROS 1 bag); ".log", ".clf", ".carmen" and those with ".gz" (CARMEN log). A CARMEN log has
/// one kind of line for poses and one for odometry, and holds those of the first source of each.
///
/// It is written as `path`.part, and takes its name when it is finished. Errors: those of
/// can_write_recording; a path that cannot be written; a folder that is there and not empty; a ROS 1 bag in a
/// build without them.
Result<std::unique_ptr<RecordingWriter>> make_recording_writer(const std::string& path,
                                                               const RecordingWriterOptions& options = {});

}  // namespace beaconless::io
