// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/multi_laser_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace beaconless {
namespace {

constexpr double kFresh_s = 0.5;          // how long a laser's word holds
constexpr double kShortestRest_s = 0.25;  // of a laser that was set right
constexpr double kLongestRest_s = 8.0;
constexpr double kDirections = 3.0;
constexpr double kExcessMemory = 16.0;  // scans
constexpr double kMostExcess = 1e4;
constexpr double kTooFar = 21.1;         // squared distance that agreeing lasers exceed once in ten thousand
constexpr double kCarried_sigmas = 4.0;  // of what the motion may have been meanwhile, in a level
constexpr double kSlack_rad = radians(0.5);
constexpr std::string_view kDisagree = "the lasers are sure of different places";
constexpr std::string_view kUnknownFrame = "the scan is of a frame that none of the lasers has";

bool knows_where(const PoseEstimate& estimate) {
  return estimate.ok() || estimate.status == Status::degraded;
}

bool is_astray(const PoseEstimate& estimate) {
  return estimate.status == Status::lost || estimate.status == Status::relocalizing;
}

/// Whose word counts more: the status first, then how far it deserves trust.
auto standing(const PoseEstimate& estimate) {
  return std::tuple(estimate.is_trusted(), estimate.ok(), estimate.quality);
}

}  // namespace

MultiLaserLocalizer::MultiLaserLocalizer(const LocalizerConfig& config, std::vector<Laser> lasers)
    : slack_m_(config.places.sigma_m) {
  frames_.reserve(lasers.size());  // which those that say something point into
  for (Laser& laser : lasers) {
    frames_.push_back(std::move(laser.frame_id));
    said_.push_back({frames_.back(), PoseEstimate{}});
    members_.push_back({std::move(laser.localizer), LaserFix(config.motion, config.odometry)});
  }
  words_.reserve(members_.size());
}

void MultiLaserLocalizer::start_at(const Pose2& map_from_base) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].localizer->start_at(map_from_base);
    members_[i].fix.start_at(map_from_base);
    members_[i].set_right_at.reset();
    said_[i].estimate = PoseEstimate{};
  }
  last_ = PoseEstimate{};
  last_.map_from_base = map_from_base;
}

void MultiLaserLocalizer::start_anywhere(const std::optional<SearchRegion>& within) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].localizer->start_anywhere(within);
    members_[i].set_right_at.reset();
    said_[i].estimate = PoseEstimate{};
  }
  last_ = PoseEstimate{};
}

std::span<const PoseCandidate> MultiLaserLocalizer::candidates() const {
  if (knows_where(last_)) return {};
  return members_[last_laser_].localizer->candidates();
}

PoseEstimate MultiLaserLocalizer::update(const Event& event) {
  const auto* scan = std::get_if<Scan>(&event);
  if (scan == nullptr) return without_scan(event);
  const std::size_t laser = laser_of(*scan);
  if (laser == members_.size()) {
    PoseEstimate estimate = last_;
    std::tie(estimate.stamp, estimate.status, estimate.reason) =
        std::tuple(scan->stamp(), Status::not_a_scan, kUnknownFrame);
    return estimate;
  }
  // 1. What the others tell of that moment. A laser that does not know where it is hears it from them.
  last_laser_ = laser;
  gather_words(scan->stamp(), laser);
  const bool is_led = is_astray(said_[laser].estimate) && !words_.empty() && best_word().estimate->ok();
  if (is_led && !is_resting(laser, scan->stamp())) set_right(laser, best_word().then.pose, scan->stamp());
  // 2. What its own laser makes of it.
  if (!is_led || !is_resting(laser, scan->stamp())) hear(laser, *scan);
  if (words_.empty()) return last_ = said_[laser].estimate;
  // 3. The one that deserves most trust, and all that agree with it.
  return last_ = together(scan->stamp(), best_word());
}

PoseEstimate MultiLaserLocalizer::without_scan(const Event& event) {
  PoseEstimate told;
  for (Member& member : members_) {
    told = member.localizer->update(event);
    if (const auto* odometry = std::get_if<Odometry>(&event)) member.fix.hear(*odometry);
  }
  PoseEstimate estimate = last_;
  estimate.stamp = told.stamp;
  estimate.status = told.status;
  estimate.reason = told.reason;
  return estimate;
}

std::size_t MultiLaserLocalizer::laser_of(const Scan& scan) const {
  return static_cast<std::size_t>(std::find(frames_.begin(), frames_.end(), scan.frame_id()) -
                                  frames_.begin());
}

bool MultiLaserLocalizer::is_resting(std::size_t laser, Stamp stamp) const {
  const Member& member = members_[laser];
  if (!member.set_right_at) return false;
  const double since_s = seconds_between(*member.set_right_at, stamp);
  return since_s > 0.0 && since_s < member.rest_s;
}

void MultiLaserLocalizer::set_right(std::size_t laser, const Pose2& map_from_base, Stamp stamp) {
  Member& member = members_[laser];
  member.localizer->start_at(map_from_base);
  member.fix.start_at(map_from_base);
  member.set_right_at = stamp;
  member.rest_s = std::clamp(2.0 * member.rest_s, kShortestRest_s, kLongestRest_s);
}

void MultiLaserLocalizer::hear(std::size_t laser, const Scan& scan) {
  Member& member = members_[laser];
  PoseEstimate& said = said_[laser].estimate;
  said = member.localizer->update(scan);
  if (!knows_where(said)) return;
  if (said.ok()) member.rest_s = 0.0;
  member.fix.take(said);
  words_.push_back({laser, &said, {said.map_from_base, said.covariance}});
}

void MultiLaserLocalizer::gather_words(Stamp stamp, std::size_t but_of) {
  words_.clear();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PoseEstimate& said = said_[i].estimate;
    if (i != but_of && knows_where(said) && std::abs(seconds_between(said.stamp, stamp)) < kFresh_s)
      words_.push_back({i, &said, members_[i].fix.at(stamp)});
  }
}

const MultiLaserLocalizer::Word& MultiLaserLocalizer::best_word() const {
  return *std::max_element(words_.begin(), words_.end(), [](const Word& a, const Word& b) {
    return standing(*a.estimate) < standing(*b.estimate);
  });
}

bool MultiLaserLocalizer::agree(const Word& a, const Word& b) const {
  const Eigen::Vector3d slack(slack_m_, slack_m_, kSlack_rad);
  PoseOpinion widened = a.then;
  widened.covariance.diagonal() += 2.0 * slack.cwiseAbs2();
  return squared_distance(widened, b.then) < kTooFar;
}

/// By how much a laser is off beside the best, in squared standard deviations of the two: a covariance tells
/// what the noise does, not whether what the laser sees is what the map holds.
double MultiLaserLocalizer::learn_excess(const Word& word, const Word& best) {
  auto& [excess, compared] = members_[word.laser].beside;
  const double now = std::min(squared_distance(best.then, word.then) / kDirections, kMostExcess);
  compared = std::min(compared + 1.0, kExcessMemory);
  excess += (now - excess) / compared;
  return std::max(1.0, excess);
}

PoseEstimate MultiLaserLocalizer::together(Stamp stamp, const Word& best) {
  PoseEstimate estimate = *best.estimate;
  estimate.stamp = stamp;
  // 1. The pose of all that agree.
  PoseOpinion all = best.then;
  bool is_disputed = false;
  for (const Word& word : words_) {
    if (word.laser == best.laser) continue;
    if (agree(best, word)) {
      all = fused(all, {word.then.pose, learn_excess(word, best) * word.then.covariance});
      estimate.jumped = estimate.jumped && word.estimate->jumped;
    } else if (word.estimate->ok() && word.estimate->is_trusted() == best.estimate->is_trusted()) {
      is_disputed = true;
    }
  }
  estimate.map_from_base = all.pose;
  estimate.covariance = all.covariance;
  // 2. Nobody can tell which of two is right that are equally sure.
  if (is_disputed) {
    estimate.status = Status::degraded;
    estimate.reason = kDisagree;
    estimate.quality = 0.0;
  }
  // 3. The tightest level of those that deserve trust bounds the fused pose too, by how far it is from
  // theirs.
  estimate.protection_m = PoseEstimate::kUnbounded_m;
  estimate.protection_rad = kPi;
  if (!estimate.is_trusted()) return estimate;
  for (const Word& word : words_) {
    if (!word.estimate->is_trusted() || !agree(best, word)) continue;
    const Eigen::Matrix3d carried = word.then.covariance - word.estimate->covariance;
    const double carried_m = kCarried_sigmas * std::sqrt(std::max(0.0, carried(0, 0) + carried(1, 1)));
    const double carried_rad = kCarried_sigmas * std::sqrt(std::max(0.0, carried(2, 2)));
    const double off_m = distance_m(all.pose, word.then.pose);
    const double off_rad = heading_difference_rad(all.pose, word.then.pose);
    estimate.protection_m = std::min(estimate.protection_m, word.estimate->protection_m + carried_m + off_m);
    estimate.protection_rad =
        std::min(estimate.protection_rad, word.estimate->protection_rad + carried_rad + off_rad);
  }
  return estimate;
}

}  // namespace beaconless
