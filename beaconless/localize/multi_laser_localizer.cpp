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
constexpr double kWorstExcess = 1e4;
constexpr double kMostExcess = 9.0;            // of a laser whose poses are used
constexpr double kContradicted_quality = 0.4;  // at most, where another laser sees something else
constexpr double kJump_m = 0.2;                // between two leaders, besides what may have been driven
constexpr double kFastest_mps = 3.0;
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

/// Whose word counts more.
int standing(const PoseEstimate& estimate) { return estimate.is_trusted() ? 2 : estimate.ok() ? 1 : 0; }

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

void MultiLaserLocalizer::forget() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].beside = {};
    members_[i].rest_s = 0.0;
    members_[i].set_right_at.reset();
    said_[i].estimate = PoseEstimate{};
  }
  leader_.reset();
  last_ = PoseEstimate{};
}

void MultiLaserLocalizer::start_at(const Pose2& map_from_base) {
  if (!map_from_base.is_finite()) return;
  forget();
  for (Member& member : members_) {
    member.localizer->start_at(map_from_base);
    member.fix.start_at(map_from_base);
  }
  last_.map_from_base = map_from_base;
  is_started_ = true;
}

void MultiLaserLocalizer::start_anywhere(const std::optional<SearchRegion>& within) {
  forget();
  for (Member& member : members_) member.localizer->start_anywhere(within);
  is_started_ = true;
}

std::span<const PoseCandidate> MultiLaserLocalizer::candidates() const {
  if (knows_where(last_)) return {};
  return members_[last_laser_].localizer->candidates();
}

PoseEstimate MultiLaserLocalizer::update(const Event& event) {
  const auto* scan = std::get_if<Scan>(&event);
  if (scan == nullptr) return without_scan(event);
  const std::size_t laser = laser_of(*scan);
  if (laser == members_.size()) return nothing_new(scan->stamp(), kUnknownFrame);
  // 1. What the others tell of that moment. A laser that does not know where it is hears it from them.
  last_laser_ = laser;
  gather_words(scan->stamp(), laser);
  if (is_astray(said_[laser].estimate)) set_right(laser, scan->stamp());
  // 2. What its own laser makes of it.
  hear(laser, *scan);
  if (words_.empty()) return last_ = said_[laser].estimate;
  // 3. The one that deserves most trust, and all that agree with it.
  last_leader_ = leader_.value_or(members_.size());
  return last_ = together(scan->stamp(), lead());
}

PoseEstimate MultiLaserLocalizer::without_scan(const Event& event) {
  for (Member& member : members_) {
    member.localizer->update(event);
    if (const auto* odometry = std::get_if<Odometry>(&event)) member.fix.hear(*odometry);
  }
  return nothing_new(stamp_of(event), "the event brought no scan");
}

PoseEstimate MultiLaserLocalizer::nothing_new(Stamp stamp, std::string_view reason) const {
  PoseEstimate estimate = last_;
  estimate.stamp = stamp;
  estimate.jumped = false;
  if (!is_started_) return estimate;
  estimate.status = Status::not_a_scan;
  estimate.reason = reason;
  return estimate;
}

std::size_t MultiLaserLocalizer::laser_of(const Scan& scan) const {
  return static_cast<std::size_t>(std::find(frames_.begin(), frames_.end(), scan.frame_id()) -
                                  frames_.begin());
}

void MultiLaserLocalizer::set_right(std::size_t laser, Stamp stamp) {
  Member& member = members_[laser];
  const Word* known = nullptr;
  for (const Word& word : words_)
    if (word.estimate->is_trusted()) known = &word;
  const double since_s = member.set_right_at ? seconds_between(*member.set_right_at, stamp) : kLongestRest_s;
  // In between it looks by itself, and may find that the others are wrong.
  if (known == nullptr || (since_s > 0.0 && since_s < member.rest_s)) return;
  member.localizer->start_at(known->then.pose);
  member.fix.start_at(known->then.pose);
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

/// The one that led before, as long as none deserves clearly more: two that are equally sure of different
/// places would take turns.
const MultiLaserLocalizer::Word& MultiLaserLocalizer::lead() {
  const Word* best = &words_.front();
  for (const Word& word : words_) {
    const bool has_led = leader_ && word.laser == *leader_;
    const auto [mine, its] = std::pair(standing(*word.estimate), standing(*best->estimate));
    if (mine > its || (mine == its && has_led)) best = &word;
  }
  leader_ = best->laser;
  return *best;
}

bool MultiLaserLocalizer::agree(const Word& a, const Word& b) const {
  const Eigen::Vector3d slack(slack_m_, slack_m_, kSlack_rad);
  PoseOpinion widened = a.then;
  widened.covariance.diagonal() += 2.0 * slack.cwiseAbs2();
  return squared_distance(widened, b.then) < kTooFar;
}

/// Whether the leader says so, or the lead went to one that was elsewhere.
bool MultiLaserLocalizer::has_jumped(const Word& best, const Pose2& pose) const {
  if (best.estimate->jumped && best.estimate->stamp > last_.stamp) return true;
  if (!knows_where(last_) || best.laser == last_leader_) return false;
  const double since_s = std::abs(seconds_between(last_.stamp, best.estimate->stamp));
  return distance_m(last_.map_from_base, pose) > kJump_m + kFastest_mps * since_s;
}

/// By how much a laser is off beside the best, in squared standard deviations of the two: a covariance tells
/// what the noise does, not whether what the laser sees is what the map holds.
double MultiLaserLocalizer::learn_excess(const Word& word, const Word& best) {
  auto& [excess, compared] = members_[word.laser].beside;
  const double now = std::min(squared_distance(best.then, word.then) / kDirections, kWorstExcess);
  compared = std::min(compared + 1.0, kExcessMemory);
  excess += (now - excess) / compared;
  return std::max(1.0, excess);
}

PoseEstimate MultiLaserLocalizer::together(Stamp stamp, const Word& best) {
  PoseEstimate estimate = *best.estimate;
  estimate.stamp = stamp;
  // 1. The pose of all that agree.
  PoseOpinion all = best.then;
  bool is_disputed = false;      // by one that is as sure
  bool is_contradicted = false;  // by one that sees something else
  for (Word& word : words_) {
    if (word.laser == best.laser) continue;
    const double excess = learn_excess(word, best);
    const bool is_near = agree(best, word);
    word.is_with = is_near && excess < kMostExcess;
    is_contradicted = is_contradicted || !word.is_with;
    if (word.is_with)
      all = fused(all, {word.then.pose, excess * word.then.covariance});
    else if (!is_near && word.estimate->ok())
      is_disputed = is_disputed || standing(*word.estimate) == standing(*best.estimate);
  }
  for (const LaserSays& said : said_) is_contradicted = is_contradicted || is_astray(said.estimate);
  estimate.map_from_base = all.pose;
  estimate.covariance = all.covariance;
  estimate.jumped = has_jumped(best, all.pose);
  // 2. Trust needs all lasers. Nobody can tell which of two is right that are equally sure.
  if (is_contradicted) estimate.quality = std::min(estimate.quality, kContradicted_quality);
  if (is_disputed) {
    estimate.status = Status::degraded;
    estimate.reason = kDisagree;
    estimate.quality = 0.0;
  }
  bound(estimate);
  return estimate;
}

/// The tightest level of those that deserve trust bounds the fused pose too, by how far it is from theirs.
void MultiLaserLocalizer::bound(PoseEstimate& estimate) const {
  estimate.protection_m = PoseEstimate::kUnbounded_m;
  estimate.protection_rad = kPi;
  if (!estimate.is_trusted()) return;
  for (const Word& word : words_) {
    if (!word.estimate->is_trusted() || !word.is_with) continue;
    const Eigen::Matrix3d carried = word.then.covariance - word.estimate->covariance;
    const double carried_m = kCarried_sigmas * std::sqrt(std::max(0.0, carried(0, 0) + carried(1, 1)));
    const double carried_rad = kCarried_sigmas * std::sqrt(std::max(0.0, carried(2, 2)));
    const double off_m = distance_m(estimate.map_from_base, word.then.pose);
    const double off_rad = heading_difference_rad(estimate.map_from_base, word.then.pose);
    estimate.protection_m = std::min(estimate.protection_m, word.estimate->protection_m + carried_m + off_m);
    estimate.protection_rad =
        std::min(estimate.protection_rad, word.estimate->protection_rad + carried_rad + off_rad);
  }
}

}  // namespace beaconless
