// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace beaconless {

/// Which code runs a loop that is written for several kinds of processor. All give the same but for rounding.
enum class VectorLoop {
  portable,  ///< on any processor
  avx2,      ///< on x86 with AVX2 and FMA
};

/// The fastest that this processor knows.
inline VectorLoop fastest_vector_loop() {
#if defined(__x86_64__) || defined(__i386__)
  static const bool kHasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return kHasAvx2 ? VectorLoop::avx2 : VectorLoop::portable;
#else
  return VectorLoop::portable;
#endif
}

}  // namespace beaconless
