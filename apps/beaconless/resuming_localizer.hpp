// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "beaconless/localize/localizer.hpp"

namespace beaconless::cli {

/// A localizer that is told where the robot was last, and looks everywhere when it is not there.
///
/// The pose counts once a scan is ok there within the first few; until then the statuses are those of the
/// localizer within. A robot that was carried to a place that looks the same is not told from one that was
/// not.
class ResumingLocalizer final : public Localizer {
 public:
  static constexpr int kScansToFit = 3;

  /// Starts `within` at the pose.
  ResumingLocalizer(std::unique_ptr<Localizer> within, const Pose2& last_map_from_base);

  void start_at(const Pose2& map_from_base) override;
  void start_anywhere(const std::optional<SearchRegion>& within) override;
  std::span<const PoseCandidate> candidates() const override { return within_->candidates(); }
  PoseEstimate update(const Event& event) override;

  /// Whether it had to look everywhere.
  bool has_searched() const { return has_searched_; }

 private:
  std::unique_ptr<Localizer> within_;
  int scans_left_ = kScansToFit;  // to fit at the last pose; 0: it is decided
  bool has_searched_ = false;
};

}  // namespace beaconless::cli
