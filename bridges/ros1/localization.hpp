// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "beaconless/localize/make_localizer.hpp"

namespace beaconless::ros1 {

/// A localizer whose map, lasers and start may come in any order, and change.
///
/// It is built when the map and a laser are known. Another map, one more laser, or a stamp that ran
/// backwards, begins anew where the robot was last believed to be.
class Localization {
 public:
  using Maker = std::function<Result<std::unique_ptr<Localizer>>(const LocalizerConfig&, const Map&)>;

  explicit Localization(LocalizerConfig config, Maker maker = make_localizer)
      : config_(std::move(config)), maker_(std::move(maker)) {}

  /// Errors: those of make_localizer; the old map stays then.
  Result<Done> set_map(std::shared_ptr<const Map> map);
  Result<Done> set_lasers(const std::vector<LaserOnRobot>& lasers);  ///< all there are; at least one

  void start_at(const Pose2& map_from_base);
  void start_anywhere(const std::optional<SearchRegion>& within = std::nullopt);

  /// Begins again where the robot is believed to be, with nothing remembered of what it saw before.
  void begin_anew();

  bool has_start() const { return start_.index() != 0; }  ///< told, and perhaps waiting for map and laser
  bool has_map() const { return map_ != nullptr; }
  const Map* map() const { return map_.get(); }
  bool is_ready() const { return localizer_ != nullptr; }
  const Pose2& base_from_laser(const std::string& frame_id) const {
    return base_from_laser_of(config_, frame_id);
  }
  const std::string& method() const { return config_.method; }

  /// Takes in an event; one that is ready.
  PoseEstimate update(const Event& event);

  std::span<const PoseCandidate> candidates() const { return localizer_->candidates(); }

  /// What each of several lasers tells.
  std::span<const LaserSays> lasers() const {
    return localizer_ ? localizer_->lasers() : std::span<const LaserSays>{};
  }
  bool is_confirmed() const { return is_confirmed_; }  ///< some scan since the last start was ok
  const std::optional<PoseEstimate>& last() const { return last_; }  ///< that a scan has brought

 private:
  struct Anywhere {
    std::optional<SearchRegion> within;
  };

  Result<Done> build(const LocalizerConfig& config, const std::shared_ptr<const Map>& map);
  void begin();

  LocalizerConfig config_;
  Maker maker_;
  std::shared_ptr<const Map> map_;
  bool has_lasers_ = false;
  std::unique_ptr<Localizer> localizer_;
  std::variant<std::monostate, Pose2, Anywhere> start_;
  std::optional<PoseEstimate> last_;
  bool is_confirmed_ = false;
};

}  // namespace beaconless::ros1
