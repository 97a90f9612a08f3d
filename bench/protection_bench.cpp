// SPDX-License-Identifier: Apache-2.0
// How often the error of a fit exceeds its protection level, in places that are not quite what the map says:
// protection_bench [scans = 110000] [seed = 1] [seen = 0].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <vector>

#include "beaconless/match/icp.hpp"
#include "beaconless/match/see_through.hpp"
#include "beaconless/match/walls.hpp"

#include "tests/support/faulty_scans.hpp"

namespace {

using namespace beaconless;

constexpr int kScansOfAWorld = 22;
constexpr double kLeastOnMap = 0.5;  // of a fit that is called ok at a start
constexpr double kMostThrough = 0.25;

/// Errors and levels of one kind of fault.
struct Tally {
  std::vector<double> errors_m;
  std::vector<double> levels_m;
  int scans = 0;
  int beyond_m = 0;
  int beyond_rad = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double share_below(const std::vector<double>& values, double limit) {
  const auto below = std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; });
  return values.empty() ? 0.0 : 100.0 * static_cast<double>(below) / static_cast<double>(values.size());
}

void print(std::string_view name, const Tally& t) {
  std::printf("%-15.*s %7d %7zu %6d %6d %9.2f %9.2f %8.1f %8.1f\n", static_cast<int>(name.size()),
              name.data(), t.scans, t.levels_m.size(), t.beyond_m, t.beyond_rad, 1e3 * median(t.errors_m),
              1e3 * median(t.levels_m), share_below(t.levels_m, 0.1), share_below(t.levels_m, 0.3));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && argv[1][0] == '-') return 0;  // asked for times along with all others: it measures none
  const int scans = argc > 1 ? std::atoi(argv[1]) : 110000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  const bool is_telling = argc > 3 && std::atoi(argv[3]) != 0;
  Rng rng(seed);
  using test::to_string;
  std::map<std::string_view, Tally> by_fault;
  std::map<std::string_view, Tally> by_place;
  Tally all;
  WallsScratch scratch;
  IcpScratch icp;
  const WallsConfig config;
  for (int done = 0; done < scans;) {
    const test::Place place =
        test::kPlaces[static_cast<std::size_t>(done / kScansOfAWorld) % test::kPlaces.size()];
    const test::FaultyWorld world(place, rng);
    const SurfaceMap map(std::in_place_type<WallIndex>, world.plan());
    const auto& index = std::get<WallIndex>(map);
    for (int of_world = 0; of_world < kScansOfAWorld && done < scans; ++of_world, ++done) {
      const auto fault = test::kFaults[static_cast<std::size_t>(of_world) % test::kFaults.size()];
      const test::FaultyScan scan = test::see_faulty(world, fault, rng);
      const Pose2 guess{scan.truth.x_m + rng.uniform(-0.05, 0.05), scan.truth.y_m + rng.uniform(-0.05, 0.05),
                        scan.truth.theta_rad + rng.uniform(-1.0, 1.0) * radians(3.0)};
      const MatchResult near = match_icp(scan.points, map, guess, {}, icp);
      const MatchResult fit = match_walls(scan.points, index, near.map_from_laser, 0.1, config, scratch);
      const bool is_ok = near.usable() && fit.usable() && fit.rank == 3 && fit.on_map_ratio > kLeastOnMap &&
                         see_through_share(scan.points, map, fit.map_from_laser, 9) < kMostThrough;
      const double error_m = distance_m(fit.map_from_laser, scan.truth);
      const double error_rad = heading_difference_rad(fit.map_from_laser, scan.truth);
      for (Tally* tally : {&by_fault[to_string(fault)], &by_place[to_string(place)], &all}) {
        ++tally->scans;
        if (!is_ok) continue;
        tally->errors_m.push_back(error_m);
        tally->levels_m.push_back(fit.protection.position_m);
        tally->beyond_m += error_m > fit.protection.position_m ? 1 : 0;
        tally->beyond_rad += error_rad > fit.protection.heading_rad ? 1 : 0;
      }
      if (is_ok && is_telling &&
          (error_m > fit.protection.position_m || error_rad > fit.protection.heading_rad))
        std::printf(
            "scan %d %s %s: %.1f of %.1f mm, %.3f of %.3f deg, on map %.2f, scale %.1f mm, pairs %d of %zu\n",
            done, to_string(place).data(), to_string(fault).data(), 1e3 * error_m,
            1e3 * fit.protection.position_m, degrees(error_rad), degrees(fit.protection.heading_rad),
            fit.on_map_ratio, 1e3 * fit.scale_m, fit.pair_count, scan.points.size());
    }
  }
  std::printf("%-15s %7s %7s %6s %6s %9s %9s %8s %8s\n", "", "scans", "ok", "> m", "> rad", "error_mm",
              "level_mm", "%<0.1m", "%<0.3m");
  for (const auto fault : test::kFaults) print(to_string(fault), by_fault[to_string(fault)]);
  for (const auto place : test::kPlaces) print(to_string(place), by_place[to_string(place)]);
  print("all", all);
  return 0;
}
