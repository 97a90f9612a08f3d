// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>
#include <time.h>

namespace beaconless::bench {

/// Processor time of single calls, because a robot waits for the slowest scan and not for the mean one.
///
/// Not the wall clock, but for calls that use several threads: the others do not wait for anything, and on a
/// shared machine the wall clock's p99 is that of the other programs.
class Latencies {
 public:
  explicit Latencies(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) : clock_(clock) {}

  /// Calls `work()`, remembers how long it took and gives what it gave.
  template <class Work>
  auto measure(Work&& work) {
    const double begin_us = time_us();
    auto result = work();
    benchmark::DoNotOptimize(result);
    taken_us_.push_back(time_us() - begin_us);
    return result;
  }

  /// Adds the counters p50_us, p99_us and max_us (nearest ranks).
  void report(benchmark::State& state) {
    if (taken_us_.empty()) return;
    std::sort(taken_us_.begin(), taken_us_.end());
    state.counters["p50_us"] = rank(0.50);
    state.counters["p99_us"] = rank(0.99);
    state.counters["max_us"] = taken_us_.back();
  }

 private:
  double time_us() const {
    timespec now{};
    clock_gettime(clock_, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
  }

  double rank(double share) const {
    return taken_us_[static_cast<std::size_t>(share * static_cast<double>(taken_us_.size() - 1) + 0.5)];
  }

  clockid_t clock_;
  std::vector<double> taken_us_;
};

/// Times `find(scan)` for every scan of a drive; it gives how many it found.
template <class Drive, class Find>
void each_scan(benchmark::State& state, const Drive& drive, Find&& find) {
  Latencies latencies;
  double found = 0.0;
  double scans = 0.0;
  for (auto _ : state)
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
      found += static_cast<double>(latencies.measure([&] { return find(drive.scan(i)); }));
      scans += 1.0;
    }
  latencies.report(state);
  state.counters["per_scan"] = found / scans;
}

}  // namespace beaconless::bench
