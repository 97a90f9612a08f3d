// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocations.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t counted = 0;
}

namespace beaconless::test {
std::size_t allocations() { return counted; }
}  // namespace beaconless::test

// NOLINTBEGIN(misc-new-delete-overloads): counts, and otherwise does what the default does
void* operator new(std::size_t size) {
  ++counted;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// NOLINTEND(misc-new-delete-overloads)
