// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_recording.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {

void read_zstd(Bytes bytes) { read_recording(io::open_rosbag2, bytes); }

}  // namespace beaconless::fuzz
