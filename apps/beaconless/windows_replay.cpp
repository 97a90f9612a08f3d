// SPDX-License-Identifier: Apache-2.0
#include "windows_replay.hpp"

#include <chrono>
#include <deque>

namespace beaconless::cli {
namespace {

/// An event, and which scan it is or follows.
struct Kept {
  Event event;
  std::size_t scan_index = 0;  // in the recording
};

bool is_scan(const Kept& kept) { return std::holds_alternative<Scan>(kept.event); }

WindowFound localize_window(const std::deque<Kept>& events, Localizer& localizer,
                            const StartAnywhere& start) {
  using Clock = std::chrono::steady_clock;
  WindowFound found{
      .first_scan = events.front().scan_index, .last_scan = 0, .estimate = {}, .candidates = {}};
  localizer.start_anywhere(start.within);
  for (const Kept& kept : events) {
    const auto begin = Clock::now();
    const PoseEstimate estimate = localizer.update(kept.event);
    found.took_us += std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
    if (!is_scan(kept)) continue;
    found.last_scan = kept.scan_index;
    found.estimate = estimate;
  }
  const auto candidates = localizer.candidates();
  found.candidates.assign(candidates.begin(), candidates.end());
  return found;
}

}  // namespace

WindowsReplay replay_windows(const io::Recording& recording, const io::ScanSelection& scans,
                             Localizer& localizer, const StartAnywhere& start, const Windows& windows,
                             const Console& console) {
  WindowsReplay run;
  Progress progress(console, "window", 0);
  std::deque<Kept> events;
  std::size_t scan_index = 0;
  std::size_t taken = 0;  // scans, also those that have left `events`
  std::size_t first = 0;  // of them, the one that the next window begins with
  const auto pass = recording.open_pass();
  for (bool wanted_more = true; wanted_more;) {
    auto event = pass->next();
    if (!event) break;
    const bool is_a_scan = std::holds_alternative<Scan>(*event);
    if (is_a_scan) {
      const std::size_t index = scan_index++;
      wanted_more = !scans.done_after(index);
      if (!scans.wants(index)) continue;
      ++taken;
    }
    // 1. Keep what belongs to the next window: its first scan and all that follows.
    if (taken <= first) continue;
    events.push_back({*std::move(event), scan_index - 1});
    if (!is_a_scan || taken < first + windows.length) continue;
    // 2. It is full: localize it.
    run.windows.push_back(localize_window(events, localizer, start));
    progress.step();
    // 3. Forget what the one after it does not have.
    first += windows.stride;
    std::size_t forget = windows.stride;
    while (!events.empty()) {
      if (is_scan(events.front()) && forget-- == 0) break;
      events.pop_front();
    }
  }
  run.skipped_records = pass->skipped();
  return run;
}

}  // namespace beaconless::cli
