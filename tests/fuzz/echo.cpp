// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rostopic_echo.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {

void read_echo(Bytes bytes) { read_recording(io::open_rostopic_echo, bytes); }

}  // namespace beaconless::fuzz
