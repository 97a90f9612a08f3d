// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace beaconless::test {

/// How often this thread has asked for memory so far. Counts in programs that link test_allocations.
std::size_t allocations();

}  // namespace beaconless::test
