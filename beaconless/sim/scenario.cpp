// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/scenario.hpp"

#include <cmath>

#include "beaconless/sim/drive.hpp"

namespace beaconless::sim {
namespace {

bool is_place(const Eigen::Vector2d& point) {
  return std::abs(point.x()) <= 1e6 && std::abs(point.y()) <= 1e6;
}

Result<Done> check(const LidarConfig& lidar) {
  if (lidar.angle_max_deg <= lidar.angle_min_deg)
    return Error{"angle_max_deg", "is not above angle_min_deg", "beams run counter-clockwise"};
  if (lidar.angle_max_deg - lidar.angle_min_deg > 360.0)
    return Error{"angle_max_deg", "is more than a turn above angle_min_deg", "a sweep is at most one turn"};
  if (lidar.range_max_m <= lidar.range_min_m)
    return Error{"range_max_m", "is not above range_min_m", "no beam could see anything"};
  return Done{};
}

Result<Done> check(const Person& person) {
  if (auto good = check_config(person); !good) return good;
  if (person.waypoints.empty()) return Error{"waypoints", "are none", "a person needs a place to stand"};
  for (const Eigen::Vector2d& point : person.waypoints)
    if (!is_place(point)) return Error{"waypoints", "lie outside -1e6 … 1e6 m", ""};
  return Done{};
}

Result<Done> check(const Path& path) {
  if (auto good = std::visit([](const auto& kind) { return check_config(kind); }, path); !good) return good;
  const auto* way = std::get_if<Waypoints>(&path);
  if (way != nullptr && way->points.empty())
    return Error{"points", "are none", "a drive needs a place to begin"};
  if (way != nullptr)
    for (const Eigen::Vector2d& point : way->points)
      if (!is_place(point)) return Error{"points", "lie outside -1e6 … 1e6 m", ""};
  return Done{};
}

Error inside(const std::string& part, Error error) {
  error.where = error.where.empty() ? part : part + "." + error.where;
  return error;
}

}  // namespace

std::size_t Scenario::sweep_count() const {
  // A duration that is a whole number of sweeps, but for rounding, does not gain one.
  return static_cast<std::size_t>(std::ceil(std::max(0.0, duration_s * lidar.rate_hz - 1e-6)));
}

void describe(Fields& fields, Scenario& scenario) {
  fields("duration_s", scenario.duration_s, {0, 86400}, "how long it is recorded, whatever the path takes");
  fields("seed", scenario.seed, {0, 2147483647}, "other seeds give other noise");
  fields.section("lidar", scenario.lidar);
}

Result<Done> check(const Scenario& scenario) {
  if (auto good = check_config(scenario); !good) return good;
  if (!scenario.base_from_laser.is_finite()) return Error{"base_from_laser", "is not finite", ""};
  if (auto good = check(scenario.lidar); !good) return inside("lidar", good.error());
  if (auto good = check(scenario.path); !good) return inside("path", good.error());
  for (const Person& person : scenario.people)
    if (auto good = check(person); !good) return inside("people", good.error());
  return Done{};
}

Result<Done> simulate(const Scenario& scenario, const std::function<void(const Sample&)>& on_sample) {
  if (auto good = check(scenario); !good) return good;
  const World world(scenario.plan, scenario.people);
  const Drive drive(scenario.path);
  const auto map_from_laser = [&](double time_s) {
    return drive.map_from_base(time_s) * scenario.base_from_laser;
  };
  Rng rng(static_cast<std::uint64_t>(scenario.seed));
  for (std::size_t i = 0; i < scenario.sweep_count(); ++i) {
    const double time_s = static_cast<double>(i) / scenario.lidar.rate_hz;
    Rng noise = rng.fork(i);
    on_sample(
        {measure_sweep(world, scenario.lidar, map_from_laser, time_s, noise), drive.map_from_base(time_s)});
  }
  return Done{};
}

Result<SimulatedRun> simulate(const Scenario& scenario) {
  SimulatedRun run;
  std::optional<Error> refused;
  auto done = simulate(scenario, [&](const Sample& sample) {
    auto scan = Scan::make(sample.scan);
    if (!scan) {
      refused = scan.error();
      return;
    }
    run.truth.add(sample.scan.stamp, sample.map_from_base);
    run.events.emplace_back(std::move(scan).value());
  });
  if (!done) return done.error();
  if (refused) return *refused;
  return run;
}

}  // namespace beaconless::sim
