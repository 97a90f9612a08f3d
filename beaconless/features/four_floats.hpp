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

inline Ints4 load4(const std::uint32_t* from) {
  Ints4 four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

inline void store4(const Ints4& of, std::uint32_t* to) { std::memcpy(to, &of, sizeof(of)); }
inline void store4(const Floats4& of, float* to) { std::memcpy(to, &of, sizeof(of)); }

/// e to the power of each lane, for 0 <= x <= 80, right to five millionths of the result.
///
/// Source: exp(x) = 2^n exp(f), n the nearest integer to x / ln 2, and Taylor's series of f, |f| <= 0.35.
inline Floats4 exp4(const Floats4& x) {
  constexpr float kLn2 = 0.693147181F;
  const Ints4 n = __builtin_convertvector(x * (1.0F / kLn2) + 0.5F, Ints4);
  const Floats4 f = x - __builtin_convertvector(n, Floats4) * kLn2;
  const Floats4 series =
      1.0F +
      f * (1.0F + f * (1.0F / 2 + f * (1.0F / 6 + f * (1.0F / 24 + f * (1.0F / 120 + f * (1.0F / 720))))));
  const Ints4 power = (n + 127) << 23;  // the exponent bits of 2^n
  Floats4 two_to_n;
  std::memcpy(&two_to_n, &power, sizeof(two_to_n));
  return two_to_n * series;
}

inline float sum(const Floats4& of) { return (of[0] + of[1]) + (of[2] + of[3]); }

}  // namespace beaconless
