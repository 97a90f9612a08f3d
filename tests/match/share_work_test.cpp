// SPDX-License-Identifier: Apache-2.0
// Work that several threads share: all of it once, whatever fails.
#include "beaconless/match/share_work.hpp"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

/// How often each item was worked on.
template <class Thread = std::jthread>
std::vector<int> times_of(int count, int threads) {
  std::vector<std::atomic<int>> times(static_cast<std::size_t>(count));
  share_work<Thread>(count, threads, [&](int i, std::size_t) { ++times[static_cast<std::size_t>(i)]; });
  return {times.begin(), times.end()};
}

std::vector<int> once(int count) { return std::vector<int>(static_cast<std::size_t>(count), 1); }

TEST(ShareWork, EveryItemIsDoneExactlyOnce) {
  for (const int threads : {-1, 0, 1, 2, 3, 4, 5})
    for (const int count : {0, 1, 2, 3, 7, 1000}) EXPECT_EQ(times_of(count, threads), once(count)) << threads;
}

TEST(ShareWork, WorkersAreNumberedBelowTheCountOfThreadsAndOfItems) {
  for (const int threads : {1, 2, 5})
    for (const int count : {1, 3, 100}) {
      const auto most = static_cast<std::size_t>(std::min(threads, count));
      std::vector<std::atomic<int>> inside(most);
      std::atomic<bool> is_wrong{false};
      share_work(count, threads, [&](int, std::size_t worker) {
        // A worker's buffers are its own: it is never at two items at once.
        if (worker >= most || inside[worker].fetch_add(1) != 0) is_wrong = true;
        if (worker < most) inside[worker].fetch_sub(1);
      });
      EXPECT_FALSE(is_wrong) << threads << " threads, " << count << " items";
    }
}

TEST(ShareWork, ThisThreadIsTheFirstWorker) {
  const auto here = std::this_thread::get_id();
  share_work(50, 1, [&](int, std::size_t worker) {
    EXPECT_EQ(worker, 0U);
    EXPECT_EQ(std::this_thread::get_id(), here);
  });
}

TEST(ShareWork, WhatIsThrownReachesTheCallerWhoeverThrewIt) {
  for (const int threads : {1, 2, 3, 4, 5})
    for (const int wrong : {0, 1, 500, 999}) {
      std::atomic<int> begun{0};
      try {
        share_work(1000, threads, [&](int i, std::size_t) {
          ++begun;
          if (i == wrong) throw std::runtime_error("item " + std::to_string(i));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "item " + std::to_string(wrong));
      }
      EXPECT_GE(begun, wrong + 1);
    }
}

TEST(ShareWork, OtherThreadsThanTheCallersMayThrow) {
  const auto here = std::this_thread::get_id();
  std::atomic<bool> has_thrown{false};
  const auto share = [&] {
    share_work(2, 2, [&](int, std::size_t) {
      // The caller's item lasts until the other thread has thrown.
      if (std::this_thread::get_id() == here) {
        while (!has_thrown) std::this_thread::yield();
        return;
      }
      has_thrown = true;
      throw std::logic_error("elsewhere");
    });
  };
  EXPECT_THROW(share(), std::logic_error);
}

TEST(ShareWork, OfManyThatThrowOneReachesTheCaller) {
  const auto share = [] { share_work(1000, 4, [](int, std::size_t) { throw std::runtime_error("each"); }); };
  EXPECT_THROW(share(), std::runtime_error);
}

/// Threads of a system that gives so many and no more.
template <int kMost>
struct ScarceThread {
  template <class Run>
  ScarceThread(const Run& run, std::size_t worker) {
    if (worker > kMost) throw std::system_error(EAGAIN, std::generic_category());
    thread_ = std::jthread(run, worker);
  }
  std::jthread thread_;
};

TEST(ShareWork, WhereTheSystemGivesNoThreadsTheOthersDoTheWork) {
  for (const int threads : {1, 2, 5}) {
    EXPECT_EQ(times_of<ScarceThread<0>>(1000, threads), once(1000)) << threads;
    EXPECT_EQ(times_of<ScarceThread<1>>(1000, threads), once(1000)) << threads;
    EXPECT_EQ(times_of<ScarceThread<2>>(1000, threads), once(1000)) << threads;
  }
}

}  // namespace
}  // namespace beaconless
