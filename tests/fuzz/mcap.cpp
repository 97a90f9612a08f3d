// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/recording.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {

void read_mcap(Bytes bytes) { read_recording(io::open_recording, bytes); }

}  // namespace beaconless::fuzz
