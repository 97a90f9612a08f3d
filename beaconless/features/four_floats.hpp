// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace beaconless {

/// Four numbers side by side, computed with at once. GCC and Clang know such types on every processor, and
/// fall back to four single numbers where it has no vector unit. Comparisons give all bits or none, lane by
/// lane.
using Floats4 = float __attribute__((vector_size(16)));
using Ints4 = std::int32_t __attribute__((vector_size(16)));

inline Floats4 load4(const float* from) {
  Floats4 four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

/// The lanes where `mask` is set, 0 elsewhere.
inline Floats4 where(const Ints4& mask, const Floats4& value) {
  return reinterpret_cast<Floats4>(mask &
                                   reinterpret_cast<Ints4>(value));  // NOLINT: as the vector types define it
}

inline Floats4 abs4(const Floats4& of) { return where(Ints4{} + 0x7fffffff, of); }

inline bool any(const Ints4& mask) {
  std::array<std::uint64_t, 2> halves{};
  std::memcpy(halves.data(), &mask, sizeof(mask));
  return (halves[0] | halves[1]) != 0;
}

inline float sum(const Floats4& of) { return (of[0] + of[1]) + (of[2] + of[3]); }

}  // namespace beaconless
