// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/simulated_trial.hpp"

#include <cmath>

#include "beaconless/map/rasterize.hpp"
#include "beaconless/sim/drive.hpp"

#include "bench/trust/altered_map.hpp"
#include "bench/trust/way.hpp"

namespace beaconless::trust {
namespace {

constexpr int kScans = 200;

/// Which faults a trial has.
struct Faults {
  bool people = false;
  bool moved = false;
  bool missing = false;
  bool glass = false;
};

Faults faults_of(Kind kind, Rng& rng) {
  Faults faults{kind == Kind::people, kind == Kind::moved, kind == Kind::missing, kind == Kind::glass};
  if (kind != Kind::combined) return faults;
  for (bool* fault : {&faults.people, &faults.moved, &faults.missing, &faults.glass})
    *fault = rng.uniform() < 0.6;
  if (!faults.people && !faults.moved) faults.people = faults.moved = true;
  return faults;
}

sim::LidarConfig lidar_of(Rng& rng) {
  sim::LidarConfig lidar;
  if (rng.uniform() < 0.4) {
    lidar.beam_count = 361;
    lidar.angle_min_deg = -90.0;
    lidar.angle_max_deg = 90.0;
  }
  lidar.rate_hz = rng.uniform(10.0, 40.0);
  lidar.range_sigma_m = rng.uniform(0.005, 0.020);
  return lidar;
}

/// The map that the localizer gets.
FloorPlan map_of(const Building& building, Kind kind, const Faults& faults, Rng& rng) {
  if (kind == Kind::mirrored) return mirrored(building);
  FloorPlan plan =
      faults.moved ? with_moved_furniture(building, rng.uniform(0.3, 1.0), rng).plan() : building.plan();
  if (faults.missing) plan = with_missing_walls(plan, rng.uniform(0.1, 0.5), rng);
  return plan;
}

void put_map(Trial& trial, const FloorPlan& plan, bool is_grid) {
  trial.walls = plan;
  trial.map =
      is_grid ? std::make_shared<const Map>(rasterize(plan).value()) : std::make_shared<const Map>(plan);
}

/// Where the localizer is told to begin: half of the trials at the truth, the others beside it or anywhere.
TrialStart start_of(const Pose2& truth, Rng& rng) {
  const double which = rng.uniform();
  const double way = rng.uniform(-kPi, kPi);
  const double off_m = rng.uniform(0.0, 1.0);
  const double off_rad = radians(rng.uniform(-20.0, 20.0));
  if (which < 0.5) return {0, truth};
  if (which < 0.75) return {0, stepped(truth, {off_m * std::cos(way), off_m * std::sin(way), off_rad})};
  return {0, std::nullopt};
}

/// Drives, and writes what the scanner sees into a trial.
void drive(Trial& trial, const Building& building, const sim::LidarConfig& lidar, const Faults& faults,
           Rng& rng) {
  // 1. A way through the building, begun at rest or in motion.
  const double duration_s = kScans / lidar.rate_hz;
  const double begin_s = rng.uniform() < 0.5 ? 0.0 : rng.uniform(0.5, 4.0);
  const sim::Drive way(make_way(building, begin_s + duration_s, rng));
  const sim::LaserMotion motion = [&](double time_s) {
    return way.map_from_base(begin_s + time_s) * trial.base_from_laser;
  };
  // 2. What is in the way.
  Disguise disguise;
  if (faults.people) disguise.people = make_crowd(rng.uniform(0.2, 0.6), lidar, motion, 0.0, rng);
  if (faults.glass) disguise.glass = make_glass(building, static_cast<int>(rng.uniform(2.0, 9.0)), rng);
  // 3. Scan by scan.
  const sim::World world(building.plan(), {});
  for (int i = 0; i < kScans; ++i) {
    const double time_s = i / lidar.rate_hz;
    RawScan scan = measure_sweep(world, lidar, motion, time_s, rng);
    hide(scan, disguise, lidar, motion, rng);
    trial.truth.push_back(way.map_from_base(begin_s + scan.stamp.seconds()));
    trial.events.emplace_back(Scan::make(std::move(scan)).value());
  }
}

}  // namespace

Kind kind_of(std::uint64_t seed) {
  constexpr std::array kOrder{Kind::clean, Kind::people,    Kind::people,   Kind::moved,    Kind::missing,
                              Kind::glass, Kind::wrong_map, Kind::mirrored, Kind::combined, Kind::combined};
  return kOrder[seed % kOrder.size()];
}

Family family_of(std::uint64_t seed) { return static_cast<Family>(seed / 10 % kFamilies.size()); }

Trial simulated_trial(std::uint64_t seed) {
  Rng rng(seed);
  const Kind kind = kind_of(seed);
  Trial trial{.kind = std::string(kKinds[static_cast<std::size_t>(kind)]),
              .family = std::string(kFamilies[static_cast<std::size_t>(family_of(seed))]),
              .seed = seed};
  const Building building = make_building(family_of(seed), rng);
  trial.base_from_laser = {rng.uniform(0.0, 0.3), 0.0, 0.0};
  const sim::LidarConfig lidar = lidar_of(rng);
  const Faults faults = faults_of(kind, rng);
  Rng map_rng = rng.fork(1);
  const bool is_grid = map_rng.uniform() < 0.2;
  FloorPlan plan = map_of(building, kind, faults, map_rng);
  if (kind == Kind::wrong_map)
    plan = laid_over(make_building(family_of(seed), map_rng).plan(), building.plan());
  put_map(trial, plan, is_grid);
  trial.is_of_here = kind != Kind::wrong_map && kind != Kind::mirrored;
  drive(trial, building, lidar, faults, rng);
  trial.starts.push_back(start_of(trial.truth.front(), rng));
  return trial;
}

std::array<Trial, 2> simulated_parts(std::uint64_t seed) {
  Rng rng(seed);
  const Building building = make_building(static_cast<Family>(seed / 2 % kFamilies.size()), rng);
  const sim::LidarConfig lidar = lidar_of(rng);
  Trial trial{
      .kind = "kidnapping", .family = std::string(kFamilies[seed / 2 % kFamilies.size()]), .seed = seed};
  trial.base_from_laser = {rng.uniform(0.0, 0.3), 0.0, 0.0};
  put_map(trial, building.plan(), rng.uniform() < 0.2);
  std::array<Trial, 2> parts{trial, trial};
  for (Trial& part : parts) {
    drive(part, building, lidar, {}, rng);
    part.starts.push_back({0, part.truth.front()});
  }
  return parts;
}

}  // namespace beaconless::trust
