// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/geometry/pose_fusion.hpp"
#include "beaconless/localize/laser_fix.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"

namespace beaconless {

/// One estimate from several lasers on one robot, each with its own place and its own clock ticks.
///
/// Every laser has a localizer of its own, which sees only its scans. What the others told last is carried to
/// the moment of a scan by the robot's motion, and what agrees is fused by its information, widened by how
/// far off each was of late: lasers that see different walls help each other along the directions that one
/// of them cannot see. Trust needs all of them: while one is lost, or elsewhere, the quality stays below 0.5;
/// two that are equally sure of different places are told as such. One that is lost is set, ever less often,
/// to where a trusted one is, and looks by itself in between. Differs: the map's own errors are common to all
/// lasers and are not averaged; the fused covariance does not know of them. The risk of the level is that of
/// the lasers added up.
///
/// A scan of a frame that no laser has changes nothing, and its estimate says so. Cost: that of a single
/// localizer, and some microseconds.
class MultiLaserLocalizer final : public Localizer {
 public:
  struct Laser {
    std::string frame_id;
    std::unique_ptr<Localizer> localizer;
  };

  /// In: at least one laser, frames all different.
  MultiLaserLocalizer(const LocalizerConfig& config, std::vector<Laser> lasers);

  void start_at(const Pose2& map_from_base) override;
  void start_anywhere(const std::optional<SearchRegion>& within) override;
  std::span<const PoseCandidate> candidates() const override;
  std::span<const LaserSays> lasers() const override { return said_; }
  PoseEstimate update(const Event& event) override;

 private:
  /// How a laser's poses compare with those of better ones.
  struct Beside {
    double excess = 1.0;    // mean squared distance, of 1 where both covariances tell all
    double compared = 0.0;  // scans, as far as they are remembered
  };

  struct Member {
    std::unique_ptr<Localizer> localizer;
    LaserFix fix;
    Beside beside;
    double rest_s = 0.0;  // after it was set right in vain, again and again
    std::optional<Stamp> set_right_at = std::nullopt;
  };

  /// What a laser tells of the moment of another's scan.
  struct Word {
    std::size_t laser = 0;
    const PoseEstimate* estimate = nullptr;
    PoseOpinion then;
    bool is_with = true;  // the leading one
  };

  PoseEstimate without_scan(const Event& event);
  std::size_t laser_of(const Scan& scan) const;
  void set_right(std::size_t laser, Stamp stamp);
  const Word& lead();
  bool has_jumped(const Word& best, const Pose2& pose) const;
  void forget();
  PoseEstimate nothing_new(Stamp stamp, std::string_view reason) const;
  void hear(std::size_t laser, const Scan& scan);
  void gather_words(Stamp stamp, std::size_t but_of);
  double learn_excess(const Word& word, const Word& best);
  bool agree(const Word& a, const Word& b) const;
  void bound(PoseEstimate& estimate) const;
  PoseEstimate together(Stamp stamp, const Word& best);

  double slack_m_;  // by how much two lasers may be off, each by another piece of the map
  std::vector<Member> members_;
  std::vector<LaserSays> said_;
  std::vector<std::string> frames_;
  std::vector<Word> words_;
  std::size_t last_laser_ = 0;
  std::optional<std::size_t> leader_;
  std::size_t last_leader_ = 0;
  bool is_started_ = false;
  PoseEstimate last_;
};

}  // namespace beaconless
