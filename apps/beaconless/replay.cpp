// SPDX-License-Identifier: Apache-2.0
#include "replay.hpp"

#include <algorithm>
#include <chrono>

namespace beaconless::cli {
namespace {

constexpr std::size_t kOverlayScans = 12;
constexpr std::size_t kGoodScans = 40;

std::uint64_t scans_of(const io::Recording& recording) {
  for (const io::Topic& topic : recording.topics())
    if (topic.name == recording.scan_topic()) return topic.count;
  return 0;
}

/// Keeps `least` to twice as many scans, evenly spread, without knowing how many will come: every stride-th,
/// the stride doubling.
class Overlay {
 public:
  explicit Overlay(std::size_t least) : least_(least) {}
  void add(const Scan& scan, const Pose2& map_from_laser) {
    if (seen_++ % stride_ != 0) return;
    kept_.push_back({scan, map_from_laser});
    if (kept_.size() < 2 * least_) return;
    for (std::size_t i = 0; i < least_; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize(least_, kept_.front());
    stride_ *= 2;
  }
  std::vector<report::PlacedScan> take() { return std::move(kept_); }

 private:
  std::size_t least_;
  std::vector<report::PlacedScan> kept_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

/// Keeps the places that fitted at the first and at the last scan of every search, of the first searches.
class PlacesLog {
 public:
  void hear(std::size_t scan_index, const PoseEstimate& estimate, std::span<const PoseCandidate> candidates) {
    const bool is_search = !candidates.empty();
    if (is_search && !was_search_) is_open_ = kept_.size() + 2 <= kMostPlaces;
    if (is_search && is_open_) {
      // The first stays; what comes after it replaces what came before.
      if (was_search_ && has_second_) kept_.pop_back();
      has_second_ = was_search_;
      kept_.push_back(places_of(scan_index, estimate, candidates));
    }
    was_search_ = is_search;
    if (!is_search) has_second_ = false;
  }
  std::vector<report::CandidatePlaces> take() { return std::move(kept_); }

 private:
  static constexpr std::size_t kMostPlaces = 60;
  static constexpr std::size_t kMostCandidates = 20;

  static report::CandidatePlaces places_of(std::size_t scan_index, const PoseEstimate& estimate,
                                           std::span<const PoseCandidate> candidates) {
    report::CandidatePlaces places{scan_index, estimate.stamp, {}, candidates.size()};
    for (const PoseCandidate& c : candidates.first(std::min(candidates.size(), kMostCandidates)))
      places.places.push_back({c.map_from_base, c.score, c.weight});
    return places;
  }

  std::vector<report::CandidatePlaces> kept_;
  bool was_search_ = false;
  bool has_second_ = false;
  bool is_open_ = false;
};

}  // namespace

Replay replay(const io::Recording& recording, const io::ScanSelection& scans, Localizer& localizer,
              const LocalizerConfig& config, const Console& console, const StartAt& start_at,
              const HeardBy& heard_by) {
  using Clock = std::chrono::steady_clock;
  Replay run;
  Overlay overlay(kOverlayScans);
  Overlay good_scans(kGoodScans);
  PlacesLog places;
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
    if (heard_by) heard_by(*event, estimate);
    if (scan == nullptr) continue;
    places.hear(scan_index - 1, estimate, localizer.candidates());
    run.estimates.push_back(estimate);
    run.scan_indices.push_back(scan_index - 1);
    run.update_us.push_back(took_us);
    const Pose2 map_from_laser = estimate.map_from_base * base_from_laser_of(config, scan->frame_id());
    overlay.add(*scan, map_from_laser);
    if (estimate.ok()) good_scans.add(*scan, map_from_laser);
  }
  run.skipped_records = events->skipped();
  run.overlay = overlay.take();
  run.good_scans = good_scans.take();
  run.places = places.take();
  return run;
}

}  // namespace beaconless::cli
