// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/follow.hpp"

#include <cmath>

#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/map/ray_caster.hpp"

namespace beaconless::trust {
namespace {

/// The share of a scan's hits that end within 10 cm of where the map's walls say, from a pose.
double explained_share(const RayCaster& walls, const Scan& scan, const Pose2& map_from_laser) {
  constexpr double kNear_m = 0.10;
  double near = 0.0;
  double hits = 0.0;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!scan.is_hit(beam)) continue;
    const auto range = static_cast<double>(scan.ranges_m()[beam]);
    const auto hit = walls.cast(map_from_laser.translation(),
                                map_from_laser.rotation() * scan.direction(beam), range + 2.0 * kNear_m);
    near += hit && std::abs(hit->range_m - range) < kNear_m ? 1.0 : 0.0;
    hits += 1.0;
  }
  return hits > 0.0 ? near / hits : 0.0;
}

bool is_right(const Trial& trial, const ScanRecord& record) {
  return record.error_m() <= kWrong_m + trial.reference_m &&
         record.error_rad() <= kWrong_rad + trial.reference_rad;
}

void start(Localizer& localizer, const TrialStart& told) {
  if (told.map_from_base)
    localizer.start_at(*told.map_from_base);
  else
    localizer.start_anywhere();
}

}  // namespace

std::unique_ptr<Localizer> localizer_for(const Trial& trial, const std::string& method) {
  LocalizerConfig config;
  config.method = method;
  config.base_from_laser = trial.base_from_laser;
  if (trial.sigma_m) {
    config.walls.sigma_m = *trial.sigma_m;
    config.icp.sigma_m = *trial.sigma_m;
    config.hector.sigma_m = *trial.sigma_m;
  }
  return make_localizer(config, *trial.map).value();
}

std::vector<ScanRecord> follow(const Trial& trial, const std::string& method) {
  const auto localizer = localizer_for(trial, method);
  std::optional<RayCaster> walls;
  if (trial.walls) walls.emplace(trial.walls->segments());
  std::vector<ScanRecord> records;
  auto next_start = trial.starts.begin();
  for (const Event& event : trial.events) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan != nullptr && next_start != trial.starts.end() && next_start->scan == records.size())
      start(*localizer, *next_start++);
    const PoseEstimate estimate = localizer->update(event);
    if (scan == nullptr) continue;
    ScanRecord record{.estimate = estimate, .truth = trial.truth[records.size()]};
    record.is_right = is_right(trial, record);
    if (walls && estimate.ok() && !record.is_right) {
      record.explained = explained_share(*walls, *scan, estimate.map_from_base * trial.base_from_laser);
      if (trial.is_of_here)
        record.explained_at_truth = explained_share(*walls, *scan, record.truth * trial.base_from_laser);
    }
    records.push_back(record);
  }
  return records;
}

}  // namespace beaconless::trust
