// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_log.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {

void read_carmen(Bytes bytes) { read_recording(io::open_carmen_log, bytes); }

}  // namespace beaconless::fuzz
