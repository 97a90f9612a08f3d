// SPDX-License-Identifier: Apache-2.0
// How fast this machine is right now: three fixed loops that have nothing to do with localization. The time
// of anything else divided by theirs can be compared between machines, compilers and days.
#include <array>

#include <benchmark/benchmark.h>

#include "bench/vector_pace.hpp"

namespace {

/// 100 000 multiply-adds, each waiting for the one before: the pace of one core on code without parallelism.
void scalar_multiply_adds(benchmark::State& state) {
  double x = 1.0;
  for (auto _ : state) {
    for (int i = 0; i < 100'000; ++i) x = x * 0.999'999 + 1e-6;
    benchmark::DoNotOptimize(x);
  }
}

/// 1 000 448 multiply-adds on 4 KiB of floats, which any compiler vectorises: the pace of the vector units.
void vector_multiply_adds(benchmark::State& state) {
  constexpr int kPasses = 977;
  std::array<float, 1024> values{};
  for (auto _ : state) {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (float& value : values) value = value * 0.9999F + 1e-4F;
      benchmark::ClobberMemory();
    }
    benchmark::DoNotOptimize(values);
  }
}

/// 200 million float operations on 8 KiB: what us_per_loop_ms of other benchmarks divides by.
void vector_loop(benchmark::State& state) {
  for (auto _ : state) beaconless::bench::run_vector_loop();
}

BENCHMARK(scalar_multiply_adds)->Unit(benchmark::kMicrosecond);
BENCHMARK(vector_multiply_adds)->Unit(benchmark::kMicrosecond);
BENCHMARK(vector_loop)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
