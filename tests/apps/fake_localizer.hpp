// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "beaconless/localize/localizer.hpp"

namespace beaconless {

/// A localizer that believes what it was told to: one estimate for each scan after a start, its last again
/// and again; and that notes what it is called with.
class FakeLocalizer final : public Localizer {
 public:
  /// What it says after the n-th scan since it was started.
  struct Answer {
    Status status = Status::ok;
    Pose2 map_from_base;
    double quality = 1.0;
    std::vector<PoseCandidate> candidates;
  };

  std::vector<Answer> after_start_at{Answer{}};
  std::vector<Answer> after_start_anywhere{Answer{}};

  std::vector<Pose2> starts;
  std::vector<std::optional<SearchRegion>> searches;
  std::vector<std::vector<Stamp>> scans;  ///< those that came after each start
  std::size_t odometry_count = 0;

  void start_at(const Pose2& map_from_base) override {
    starts.push_back(map_from_base);
    begin(after_start_at);
  }
  void start_anywhere(const std::optional<SearchRegion>& within) override {
    searches.push_back(within);
    begin(after_start_anywhere);
  }
  std::span<const PoseCandidate> candidates() const override { return last_.candidates; }

  PoseEstimate update(const Event& event) override {
    PoseEstimate estimate;
    estimate.stamp = stamp_of(event);
    if (std::holds_alternative<Odometry>(event)) ++odometry_count;
    if (answers_ == nullptr) return estimate;
    const bool is_scan = std::holds_alternative<Scan>(event);
    if (is_scan) {
      last_ = (*answers_)[std::min(scans.back().size(), answers_->size() - 1)];
      scans.back().push_back(stamp_of(event));
    }
    estimate.map_from_base = last_.map_from_base;
    estimate.status = is_scan ? last_.status : Status::not_a_scan;
    estimate.reason = estimate.ok() ? "" : "it was told so";
    estimate.quality = last_.quality;
    return estimate;
  }

 private:
  void begin(const std::vector<Answer>& answers) {
    answers_ = &answers;
    last_ = Answer{};
    scans.emplace_back();
  }

  const std::vector<Answer>* answers_ = nullptr;
  Answer last_;
};

}  // namespace beaconless
