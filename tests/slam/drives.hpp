// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "beaconless/slam/hector_slam.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless::test {

/// A scan, and where the laser truly was.
struct TrueScan {
  Scan scan;
  Pose2 map_from_laser;
};

inline Scan scan_at(const RayCaster& walls, const Pose2& pose, double sigma_m, Rng& rng, Stamp stamp) {
  return Scan::make(sweep(walls, pose, sigma_m, rng, stamp)).value();
}

/// Rounds through the niche room, about the pillar: an ellipse, heading along it, 40 scans a round at 8 Hz.
inline std::vector<TrueScan> rounds(const FloorPlan& room, double sigma_m, int scans, int scans_a_round = 40,
                                    std::uint64_t seed = 1) {
  const RayCaster walls(room.segments());
  Rng rng(seed);
  std::vector<TrueScan> drive;
  for (int i = 0; i < scans; ++i) {
    const double angle = 2.0 * kPi * i / scans_a_round - kPi / 2.0;
    const Pose2 pose{3.0 + 2.0 * std::cos(angle), 2.2 + 1.0 * std::sin(angle),
                     std::atan2(1.0 * std::cos(angle), -2.0 * std::sin(angle))};
    drive.push_back({scan_at(walls, pose, sigma_m, rng, Stamp::from_seconds(i / 8.0)), pose});
  }
  return drive;
}

/// A hall of 30 x 8 m with walls across, open in turn on one side or the other.
inline FloorPlan hall() {
  return {{{{0, 0}, {30, 0}, {30, 8}, {0, 8}, {0, 0}},
           {{5, 4}, {5, 8}},
           {{9, 0}, {9, 5}},
           {{14, 3}, {14, 8}},
           {{19, 0}, {19, 4.5}},
           {{25, 3.5}, {25, 8}}}};
}

/// Through the hall from its left end, to the n-th scan.
inline Pose2 through_hall(int scan) {
  return {1.0 + 0.1 * scan, 3.2 + 1.6 * std::sin(0.06 * scan), 0.3 * std::cos(0.06 * scan)};
}

inline HectorSlam slam_at(const Pose2& start, const HectorSlamConfig& config = {}) {
  return HectorSlam::make(config, start).value();
}

}  // namespace beaconless::test
