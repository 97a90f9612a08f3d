// SPDX-License-Identifier: Apache-2.0
// Localizes a recording on a map and writes a TUM trajectory:
//   01_localize_a_recording drive.log map.yaml 1.2 3.4 90 trajectory.tum
#include <cstdlib>
#include <iostream>

// README begin
#include <beaconless/beaconless.hpp>
using namespace beaconless;

void localize(const char* drive, const char* hall, const Pose2& start, const char* out) {
  const Map map = io::read_map(hall).value();
  const auto recording = io::open_recording(drive).value();
  auto localizer = make_localizer({}, map).value();
  localizer->start_at(start);
  io::TumWriter trajectory{out};
  for (const Event& event : recording)
    if (const PoseEstimate fix = localizer->update(event); fix.ok()) trajectory.write(fix);
}
// README end

int main(int argc, char** argv) {
  if (argc != 7) {
    std::cerr << "usage: 01_localize_a_recording RECORDING MAP X_M Y_M DEG OUT.tum\n";
    return 2;
  }
  try {
    localize(argv[1], argv[2], {std::atof(argv[3]), std::atof(argv[4]), radians(std::atof(argv[5]))},
             argv[6]);
  } catch (const BadResult& error) {
    std::cerr << error.what() << "\n";
    return 3;
  }
}
