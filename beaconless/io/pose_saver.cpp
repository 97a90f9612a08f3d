// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/pose_saver.hpp"

#include <cmath>

namespace beaconless::io {

Result<Done> PoseSaver::update(const PoseEstimate& estimate) {
  if (!estimate.is_trusted()) return Done{};
  good_ = estimate;
  // Clocks that are set back must not keep the file from being written.
  if (tried_ && std::abs(seconds_between(*tried_, estimate.stamp)) < kPause_s) return Done{};
  tried_ = estimate.stamp;
  return finish();
}

Result<Done> PoseSaver::finish() {
  if (!good_) return Done{};
  auto written = write_last_pose(path_, last_pose_of(*good_, map_));
  if (written) good_.reset();
  return written;
}

}  // namespace beaconless::io
