// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "beaconless/io/last_pose.hpp"

namespace beaconless::io {

/// Keeps a file with the last good pose while a robot drives.
///
/// Only estimates that are ok and deserve trust count: a start from a wrong pose that fits would be believed.
/// Writes at most once in `kPause_s` of their time, because every writing
/// waits for the disk.
class PoseSaver {
 public:
  static constexpr double kPause_s = 1.0;

  PoseSaver(std::string path, MapIdentity map) : path_(std::move(path)), map_(std::move(map)) {}

  /// Takes in an estimate. Errors: those of writing; the next one is tried again.
  Result<Done> update(const PoseEstimate& estimate);

  /// Writes the last good pose if it is not in the file yet.
  Result<Done> finish();

 private:
  std::string path_;
  MapIdentity map_;
  std::optional<PoseEstimate> good_;  // the last, until it is written
  std::optional<Stamp> tried_;        // when the file was written last, or could not be
};

}  // namespace beaconless::io
