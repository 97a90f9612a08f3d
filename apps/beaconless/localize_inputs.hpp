// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "beaconless/io/recording.hpp"
#include "beaconless/map/map.hpp"

#include "localize_plan.hpp"
#include "poses_of.hpp"
#include "replay.hpp"

namespace beaconless::cli {

/// A scan and its place in the recording.
struct FirstScan {
  std::size_t index = 0;
  Scan scan;
};

/// What a run of `localize` reads, opened.
struct LocalizeInputs {
  io::Recording recording;
  std::shared_ptr<const Map> map;
  std::vector<LaserOnRobot> lasers;  ///< where there are several
  FirstScan first;
  Start start;
  StartAt start_at;                  ///< of every scan by itself, where that was asked for
  std::optional<PosesOf> reference;  ///< to compare with
};

/// Opens and looks into all that the words name.
///
/// Errors: files that cannot be read or hold nothing of use. Problems of the recording go to `problems`,
/// which must live as long as it; those of pose files are told at once.
Result<LocalizeInputs> open_inputs(const Console& console, const LocalizeWords& words,
                                   const LocalizePlan& plan, ProblemLog& problems);

}  // namespace beaconless::cli
