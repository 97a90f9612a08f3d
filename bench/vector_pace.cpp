// SPDX-License-Identifier: Apache-2.0
#include "bench/vector_pace.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <time.h>

#include "beaconless/match/vector_loop.hpp"

namespace beaconless::bench {
namespace {

using Values = std::array<float, 2048>;

constexpr int kPasses = 48'828;
constexpr int kRepetitions = 5;

#define PASS_OVER(values)                                        \
  for (int pass = 0; pass < kPasses; ++pass) {                   \
    for (float& value : values) value = value * 0.9999F + 1e-4F; \
    asm volatile("" : : "r"(values.data()) : "memory");          \
  }

void run_portable(Values& values) { PASS_OVER(values) }
#if defined(__x86_64__) || defined(__i386__)
__attribute__((target("avx2,fma"))) void run_avx2(Values& values) { PASS_OVER(values) }
#else
void run_avx2(Values& values) { run_portable(values); }
#endif

double thread_time_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void run_vector_loop() {
  alignas(64) static Values values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) * 1e-3F;
  if (fastest_vector_loop() == VectorLoop::avx2)
    run_avx2(values);
  else
    run_portable(values);
}

double vector_loop_ms() {
  double best_ms = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const double begin_ms = thread_time_ms();
    run_vector_loop();
    best_ms = std::min(best_ms, thread_time_ms() - begin_ms);
  }
  return best_ms;
}

}  // namespace beaconless::bench
