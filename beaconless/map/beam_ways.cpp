// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/beam_ways.hpp"

#include <algorithm>

namespace beaconless {

void beam_ways(const Scan& scan, const Pose2& map_from_laser, const BeamReach& reach,
               std::vector<BeamWay>& ways) {
  const double no_return_m = std::min({reach.no_return_free_m, reach.max_range_m, scan.range_max_m()});
  ways.clear();
  ways.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    Eigen::Vector2d end;
    bool hit = false;
    if (scan.is_hit(beam)) {
      hit = scan.ranges_m()[beam] <= reach.max_range_m;
      end = hit ? scan.point(beam) : Eigen::Vector2d(reach.max_range_m * scan.direction(beam));
    } else if (scan.beams()[beam] == Beam::no_return && no_return_m > 0.0) {
      end = no_return_m * scan.direction(beam);
    } else {
      continue;
    }
    ways.push_back({map_from_laser * end, hit});
  }
}

}  // namespace beaconless
