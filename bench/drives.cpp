// SPDX-License-Identifier: Apache-2.0
#include "bench/drives.hpp"

#include <cstdlib>
#include <filesystem>

#include "beaconless/io/plan_io.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/scenario_io.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/map/grid_builder.hpp"
#include "beaconless/sim/scenario.hpp"

namespace beaconless::bench {

Drive simulated_drive(const std::string& scenario_name) {
  const auto scenario =
      io::read_scenario(std::string(BEACONLESS_SOURCE_DIR) + "/data/scenarios/" + scenario_name + ".yaml")
          .value();
  Drive drive{.name = scenario_name, .plan = scenario.plan, .base_from_laser = scenario.base_from_laser};
  sim::simulate(scenario, [&drive](const sim::Sample& sample) {
    drive.raw_scans.push_back(sample.scan);
    drive.scans.emplace_back(Scan::make(sample.scan).value());
    drive.truth.add(sample.scan.stamp, sample.map_from_base);
  }).value();
  return drive;
}

std::string recorded_file(const std::string& name) {
  const char* named = std::getenv("BEACONLESS_DATA");
  const std::filesystem::path folder = named != nullptr
                                           ? std::filesystem::path(named)
                                           : std::filesystem::path(BEACONLESS_SOURCE_DIR) / "../shared/data";
  return std::filesystem::exists(folder / name) ? (folder / name).string() : "";
}

std::optional<Drive> recorded_drive(const std::string& name, const std::string& plan) {
  const std::string log = recorded_file(name + ".carmen.log.gz");
  const std::string truth = recorded_file(name + ".truth.tum");
  const std::string walls = recorded_file(plan);
  if (log.empty() || truth.empty() || walls.empty()) return std::nullopt;
  Drive drive{.name = std::filesystem::path(name).filename().string(),
              .plan = io::read_plan(walls).value(),
              .truth = io::read_tum(truth).value()};
  for (const Event& event : io::open_recording(log).value())
    if (std::holds_alternative<Scan>(event)) drive.scans.push_back(event);
  if (drive.scans.size() != drive.truth.size())
    throw BadResult({.where = log, .what = "not as many scans as true poses"});
  return drive;
}

OccupancyGrid grid_of(const Drive& drive, double resolution_m) {
  auto builder = GridBuilder::make({.resolution_m = resolution_m}).value();
  for (std::size_t i = 0; i < drive.scans.size(); ++i)
    builder.add(drive.scan(i), drive.map_from_laser(i)).value();
  return builder.grid();
}

std::vector<Eigen::Vector2d> points_of(const Scan& scan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) points.push_back(scan.point(beam));
  return points;
}

}  // namespace beaconless::bench
