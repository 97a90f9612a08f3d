// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace beaconless {

/// Calls work(i, worker) once for every i below `count`, on up to `threads` threads, this one among them.
///
/// Workers are numbered from 0; each takes the next i when it is done with one, in no order that can be
/// relied on. The threads end before this returns. Cost: some 50 µs a further thread. What `work` throws on
/// one of those ends the program.
template <class Work>
void share_work(int count, int threads, const Work& work) {
  std::atomic<int> next{0};
  const auto run = [&](std::size_t worker) {
    for (int i = next.fetch_add(1); i < count; i = next.fetch_add(1)) work(i, worker);
  };
  const auto workers = static_cast<std::size_t>(std::clamp(threads, 1, std::max(1, count)));
  std::vector<std::jthread> others;
  others.reserve(workers - 1);
  for (std::size_t worker = 1; worker < workers; ++worker) others.emplace_back(run, worker);
  run(0);
}

}  // namespace beaconless
