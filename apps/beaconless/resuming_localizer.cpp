// SPDX-License-Identifier: Apache-2.0
#include "resuming_localizer.hpp"

#include <utility>

namespace beaconless::cli {

ResumingLocalizer::ResumingLocalizer(std::unique_ptr<Localizer> within, const Pose2& last_map_from_base)
    : within_(std::move(within)) {
  within_->start_at(last_map_from_base);
}

void ResumingLocalizer::start_at(const Pose2& map_from_base) {
  scans_left_ = 0;
  within_->start_at(map_from_base);
}

void ResumingLocalizer::start_anywhere(const std::optional<SearchRegion>& within) {
  scans_left_ = 0;
  within_->start_anywhere(within);
}

PoseEstimate ResumingLocalizer::update(const Event& event) {
  PoseEstimate estimate = within_->update(event);
  if (scans_left_ == 0 || !std::holds_alternative<Scan>(event)) return estimate;
  --scans_left_;
  if (estimate.ok()) {
    scans_left_ = 0;
  } else if (scans_left_ == 0) {
    has_searched_ = true;
    within_->start_anywhere();
    estimate = within_->update(event);  // the scan that did not fit there is the first of the search
  }
  return estimate;
}

}  // namespace beaconless::cli
