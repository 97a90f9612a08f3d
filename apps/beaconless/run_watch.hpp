// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "beaconless/io/black_box.hpp"
#include "beaconless/io/map_identity.hpp"
#include "beaconless/io/pose_saver.hpp"

#include "localize_plan.hpp"

namespace beaconless::cli {

/// What is written down while a run goes on: the last good pose, and boxes where the robot loses its way.
///
/// Disks that refuse are told about once each, and never stop the run.
class RunWatch {
 public:
  /// `start`: the words of --start that begin the same run, where it was given another way too.
  RunWatch(const Console& console, const LocalizeWords& words, const LocalizePlan& plan,
           const io::MapIdentity& map, const std::string& start);

  void update(const Event& event, const PoseEstimate& estimate);
  void finish();

 private:
  void told(const Result<Done>& saved);
  void told(const Result<std::optional<io::WrittenBox>>& box);

  const Console& console_;
  std::optional<io::PoseSaver> saver_;
  std::optional<io::BlackBox> box_;
  bool is_save_told_ = false;
  bool is_box_told_ = false;
  bool is_full_told_ = false;
};

}  // namespace beaconless::cli
