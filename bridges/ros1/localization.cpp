// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/localization.hpp"

namespace beaconless::ros1 {

Result<Done> Localization::set_map(std::shared_ptr<const Map> map) {
  if (has_lasers_)
    if (auto built = build(config_, map); !built) return built.error();
  map_ = std::move(map);
  return Done{};
}

Result<Done> Localization::set_lasers(const std::vector<LaserOnRobot>& lasers) {
  LocalizerConfig config = config_;
  config.base_from_laser = lasers.front().base_from_laser;
  config.lasers.clear();
  if (lasers.size() > 1) config.lasers = lasers;
  if (map_)
    if (auto built = build(config, map_); !built) return built.error();
  config_ = std::move(config);
  has_lasers_ = true;
  return Done{};
}

Result<Done> Localization::build(const LocalizerConfig& config, const std::shared_ptr<const Map>& map) {
  auto made = maker_(config, *map);
  if (!made) return made.error();
  localizer_ = *std::move(made);
  begin_anew();
  return Done{};
}

void Localization::start_at(const Pose2& map_from_base) {
  start_ = map_from_base;
  begin();
}

void Localization::start_anywhere(const std::optional<SearchRegion>& within) {
  start_ = Anywhere{within};
  begin();
}

void Localization::begin_anew() {
  // What was believed last is worth more than what was told long ago.
  if (last_ && (last_->ok() || last_->status == Status::degraded)) start_ = last_->map_from_base;
  begin();
}

void Localization::begin() {
  last_.reset();
  is_confirmed_ = false;
  if (!localizer_) return;
  if (const auto* pose = std::get_if<Pose2>(&start_)) localizer_->start_at(*pose);
  if (const auto* anywhere = std::get_if<Anywhere>(&start_)) localizer_->start_anywhere(anywhere->within);
}

PoseEstimate Localization::update(const Event& event) {
  PoseEstimate estimate = localizer_->update(event);
  if (!std::holds_alternative<Scan>(event)) return estimate;
  last_ = estimate;
  is_confirmed_ = is_confirmed_ || estimate.ok();
  return estimate;
}

}  // namespace beaconless::ros1
