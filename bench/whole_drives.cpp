// SPDX-License-Identifier: Apache-2.0
#include "bench/whole_drives.hpp"

#include <array>
#include <iostream>

#include <benchmark/benchmark.h>

namespace beaconless::bench {

std::vector<SharedDrive> whole_drives(const std::string& scenario) {
  constexpr std::array<std::array<const char*, 2>, 2> kRooms{{
      {"sim_rooms/a1_static", "sim_rooms/a_room4x3.plan.yaml"},
      {"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8.plan.yaml"},
  }};
  std::vector<SharedDrive> drives{std::make_shared<const Drive>(simulated_drive(scenario))};
  for (const auto& [name, plan] : kRooms) {
    if (auto drive = recorded_drive(name, plan))
      drives.push_back(std::make_shared<const Drive>(std::move(*drive)));
    else
      std::cerr << "no " << name << " below BEACONLESS_DATA: left out\n";
  }
  return drives;
}

int run_benchmarks(int argc, char** argv, const std::function<void()>& add) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    add();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 3;
  }
}

}  // namespace beaconless::bench
