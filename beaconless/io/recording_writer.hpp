// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/mcap_compression.hpp"

namespace beaconless::io {

/// How to write a recording.
struct RecordingWriterOptions {
  std::string scan_topic;                               ///< where the format has topics; no topic: /scan
  McapCompression compression = McapCompression::zstd;  ///< of MCAP files
};

/// Writes the events of a recording, whatever the format.
class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;

  virtual void write(const Event& event) = 0;
  virtual bool good() const = 0;

  /// Writes what is left, and says whether all of it has reached the file.
  virtual Result<Done> finish() = 0;
};

/// Opens a recording to be written; the end of its name decides: ".mcap", or ".log", ".clf", ".carmen" and
/// those with
/// ".gz" for a CARMEN log. Neither has room for where the laser sits on the robot (base_from_laser).
///
/// Errors: another end, with all that are known; a path that cannot be written.
Result<std::unique_ptr<RecordingWriter>> make_recording_writer(const std::string& path,
                                                               const RecordingWriterOptions& options = {});

}  // namespace beaconless::io
