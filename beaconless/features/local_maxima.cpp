// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/local_maxima.hpp"

#include "beaconless/features/keypoint_radius.hpp"

namespace beaconless {
namespace {

/// Whether another keypoint nearby is better than number `k`, or as good and comes first.
bool is_beaten(const std::vector<Keypoint>& candidates, std::size_t k, const Scan& scan, double radius_m) {
  const Keypoint& self = candidates[k];
  const std::size_t count = candidates.size();
  const auto reach = static_cast<std::size_t>(
                         beams_within(static_cast<float>(radius_m), static_cast<float>(self.point.norm()),
                                      static_cast<float>(1.0 / scan.angle_increment_rad()))) +
                     1;
  const auto beats = [&](const Keypoint& other) {
    if ((other.point - self.point).squaredNorm() > radius_m * radius_m) return false;
    return other.score > self.score || (other.score == self.score && other.beam < self.beam);
  };
  const auto beams_apart = [&](std::size_t from, std::size_t to) {
    return from <= to ? to - from : to + scan.size() - from;
  };
  const bool round = scan.is_full_circle();
  for (std::size_t step = 1; step < count; ++step) {  // clockwise
    if (!round && step > k) break;
    const Keypoint& other = candidates[(k + count - step) % count];
    if (beams_apart(other.beam, self.beam) > reach) break;
    if (beats(other)) return true;
  }
  for (std::size_t step = 1; step < count; ++step) {  // counter-clockwise
    if (!round && k + step >= count) break;
    const Keypoint& other = candidates[(k + step) % count];
    if (beams_apart(self.beam, other.beam) > reach) break;
    if (beats(other)) return true;
  }
  return false;
}

}  // namespace

void keep_local_maxima(const Scan& scan, double radius_m, std::vector<Keypoint>& keypoints,
                       std::vector<Keypoint>& candidates) {
  candidates.swap(keypoints);
  keypoints.clear();
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (!is_beaten(candidates, k, scan, radius_m)) keypoints.push_back(candidates[k]);
}

}  // namespace beaconless
