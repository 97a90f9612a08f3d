// SPDX-License-Identifier: Apache-2.0
#include "replay.hpp"

#include <algorithm>
#include <chrono>

namespace beaconless::cli {
namespace {

constexpr std::size_t kOverlayScans = 12;

std::uint64_t scans_of(const io::Recording& recording) {
  for (const io::Topic& topic : recording.topics())
    if (topic.name == recording.scan_topic()) return topic.count;
  return 0;
}

/// Keeps about a dozen scans, evenly spread, without knowing how many will come: every stride-th, the stride
/// doubling.
class Overlay {
 public:
  void add(const Scan& scan, const Pose2& map_from_laser) {
    if (seen_++ % stride_ != 0) return;
    kept_.push_back({scan, map_from_laser});
    if (kept_.size() < 2 * kOverlayScans) return;
    for (std::size_t i = 0; i < kOverlayScans; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize(kOverlayScans, kept_.front());
    stride_ *= 2;
  }
  std::vector<report::PlacedScan> take() { return std::move(kept_); }

 private:
  std::vector<report::PlacedScan> kept_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

}  // namespace

Replay replay(const io::Recording& recording, const io::ScanSelection& scans, Localizer& localizer,
              const Pose2& base_from_laser, const Console& console, const StartAt& start_at) {
  using Clock = std::chrono::steady_clock;
  Replay run;
  Overlay overlay;
  Progress progress(console, "scan", scans_of(recording));
  std::size_t scan_index = 0;
  const auto events = recording.open_pass();
  for (bool wanted_more = true; wanted_more;) {
    const auto event = events->next();
    if (!event) break;
    const Scan* scan = std::get_if<Scan>(&*event);
    if (scan != nullptr) {
      progress.step();
      const std::size_t index = scan_index++;
      wanted_more = !scans.done_after(index);
      if (!scans.wants(index)) continue;
      if (start_at) {
        const auto start = start_at(index, scan->stamp());
        if (!start) continue;
        localizer.start_at(*start);
      }
    }
    const auto begin = Clock::now();
    const PoseEstimate estimate = localizer.update(*event);
    const double took_us = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
    if (scan == nullptr) continue;
    run.estimates.push_back(estimate);
    run.scan_indices.push_back(scan_index - 1);
    run.update_us.push_back(took_us);
    overlay.add(*scan, estimate.map_from_base * base_from_laser);
  }
  run.skipped_records = events->skipped();
  run.overlay = overlay.take();
  return run;
}

}  // namespace beaconless::cli
