// SPDX-License-Identifier: Apache-2.0
// The door of libFuzzer; BEACONLESS_FUZZED is one of readers.hpp.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  beaconless::fuzz::BEACONLESS_FUZZED({data, size});  // what it throws ends the process: a crash
  return 0;
}
