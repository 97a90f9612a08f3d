// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::io {

/// How much a BlackBox keeps, and when it writes.
struct BlackBoxConfig {
  double keep_s = 30.0;               ///< of events before now
  std::size_t most_scans = 1500;      ///< kept at most, whatever their stamps say
  std::size_t most_events = 30'000;   ///< likewise, with odometry
  std::size_t scans_after = 10;       ///< what happened next belongs to the story
  double low_quality = 0.5;           ///< below this a pose deserves no trust
  std::size_t low_quality_scans = 5;  ///< one after the other, before that is a reason
  std::size_t most_boxes = 20;        ///< a run writes
};

/// What a box says of the run that it is from.
struct BlackBoxAbout {
  std::string start;                                       ///< the words of --start of the run
  std::vector<std::pair<std::string, std::string>> lines;  ///< key and value, such as map, map_hash, method
  std::string command_options;                             ///< of `beaconless localize` besides the start
  std::string config_yaml;                                 ///< every parameter of the run
};

/// A box that was written.
struct WrittenBox {
  std::string folder;
  std::string reason;
};

/// Keeps the last events with what was made of them, and writes them down when the robot loses its way.
///
/// A box is a folder named by the stamp and the reason: recording.log (CARMEN, the same floats),
/// estimates.csv, config.yaml, and why.yaml, which tells the reason and the command that replays it. Reasons:
/// after an ok pose of good quality the status becomes lost or relocalizing, or the quality stays low. The
/// next box needs such a pose first. Memory and the number of boxes are bounded; no file is replaced.
class BlackBox {
 public:
  BlackBox(std::string folder, BlackBoxAbout about, const BlackBoxConfig& config = {});

  /// Takes in an event and the estimate that came of it. Gives the box, if one was written.
  ///
  /// Errors: a box could not be written; the next one is tried again. Reference poses are not kept.
  Result<std::optional<WrittenBox>> update(const Event& event, const PoseEstimate& estimate);

  /// Writes the box that waits for scans which do not come any more.
  Result<std::optional<WrittenBox>> finish();

  /// Whether there was a reason for a box after the last one that a run may write.
  bool is_full() const { return is_full_; }

 private:
  struct Kept {
    Event event;
    PoseEstimate estimate;
  };

  void keep(const Event& event, const PoseEstimate& estimate);
  std::string_view reason_now(const PoseEstimate& estimate);
  Result<std::optional<WrittenBox>> write();
  Result<Done> write_files(const std::string& folder) const;
  std::string start_words() const;
  std::string why_text() const;

  std::string folder_;
  BlackBoxAbout about_;
  BlackBoxConfig config_;
  std::deque<Kept> kept_;
  std::size_t kept_scans_ = 0;
  bool has_forgotten_ = false;  // scans have left kept_
  bool is_armed_ = false;       // a pose was ok since the last box …
  bool was_good_ = false;       // … and of good quality
  std::size_t low_scans_ = 0;   // of low quality, one after the other
  std::size_t scans_to_wait_ = 0;
  std::string_view reason_;  // of the box that waits
  std::string detail_;       // in words
  Stamp when_;               // the reason arose
  std::size_t boxes_ = 0;
  bool is_full_ = false;
};

}  // namespace beaconless::io
