// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace beaconless {

/// Calls work(i, worker) once for every i below `count`, on up to `threads` threads, this one among them.
///
/// Workers are numbered from 0; each takes the next i when it is done with one, in no order that can be
/// relied on. Where the system gives fewer threads, those that there are do the work. The threads end before
/// this returns. Once `work` throws, no further i is begun, and the first of what was thrown is thrown here.
/// Cost: some 50 µs a further thread.
template <class Thread = std::jthread, class Work>
void share_work(int count, int threads, const Work& work) {
  std::atomic<int> next{0};
  std::atomic<bool> has_thrown{false};
  std::exception_ptr thrown;
  const auto run = [&](std::size_t worker) noexcept {
    try {
      for (int i = next.fetch_add(1); i < count; i = next.fetch_add(1)) work(i, worker);
    } catch (...) {
      next = count;
      if (!has_thrown.exchange(true)) thrown = std::current_exception();
    }
  };
  {
    const auto workers = static_cast<std::size_t>(std::clamp(threads, 1, std::max(1, count)));
    std::vector<Thread> others;
    others.reserve(workers - 1);
    try {
      for (std::size_t worker = 1; worker < workers; ++worker) others.emplace_back(run, worker);
    } catch (const std::system_error&) {
      // No more threads: this one and those that have begun do what there is.
    }
    run(0);
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace beaconless
