// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "bridges/ros1/node.hpp"
#include "bridges/ros1/told.hpp"

namespace beaconless::ros1 {
namespace {

constexpr std::size_t kMostWaiting = 200;
constexpr double kWheelsMayCome_s = 1.0;  // until then nobody says that there are none
constexpr double kLaserWait_s = 2.0;      // at the beginning tf may still be silent
constexpr double kAllLasersWait_s = 1.0;  // for the first scans of all, where there are several
constexpr double kTilted_rad = radians(3.0);
constexpr double kPathStep_m = 0.05;
constexpr std::size_t kLongestPath = 5000;

}  // namespace

void Node::hear_scan(const ScanMessage& scan) {
  ++scans_heard_;
  const bool is_used = lasers_.contains(scan.frame_id) || lasers_.size() < scan_topics_of(config_).size();
  if (is_used) heard_s_[scan.frame_id] = link_.steady_s();
  if (is_used && !check_stamp(scan)) {
    ++scans_dropped_;
    return;
  }
  const double now_s = link_.steady_s();
  if (!first_heard_s_) first_heard_s_ = now_s;
  waiting_.push_back({scan, now_s, std::nullopt});
  find_laser(waiting_.back());  // however many scans of others wait before it
  if (waiting_.size() > kMostWaiting) {
    waiting_.pop_front();
    ++scans_dropped_;
    complain("speed", Level::warn, "scans come faster than they are localized; the oldest are dropped",
             kRemember_s);
  }
  drain();
}

bool Node::check_stamp(const ScanMessage& scan) {
  const Stamp stamp{scan.stamp_ns};
  StampWatch& watch = stamps_[scan.frame_id];
  switch (watch.see(stamp)) {
    case StampOrder::follows:
      break;
    case StampOrder::repeated:
      complain("stamps", Level::warn,
               "a scan has the stamp of the one before, " + to_string(stamp) + "; dropped", kRemember_s);
      return false;
    case StampOrder::earlier:
      complain("stamps", Level::warn,
               "a scan is stamped earlier than the one before, " + to_string(stamp) + "; dropped",
               kRemember_s);
      return false;
    case StampOrder::jumped_back:
      complain("stamps", Level::warn,
               "the stamps of the scans jumped back to " + to_string(stamp) +
                   ": a clock was set, or a recording began anew; going on from the last pose",
               kRemember_s);
      waiting_.clear();
      last_tf_ns_ = 0;
      // The other lasers' stamps will jump as well, and once is enough.
      for (auto& [frame, other] : stamps_)
        if (&other != &watch) other = {};
      first_scan_.reset();
      last_wheels_.reset();
      localization_.begin_anew();
      break;
  }
  const std::int64_t now_ns = link_.now_ns();
  const double age_s = now_ns == 0 ? 0.0 : seconds_between(stamp, Stamp{now_ns});
  if (std::abs(age_s) > config_.late_after)
    complain(
        "late", Level::warn,
        fmt::format("scans are stamped {:.3g} s {}; check the clocks, and for a recording /use_sim_time and "
                    "rosbag play --clock",
                    std::abs(age_s), age_s > 0.0 ? "ago" : "ahead of now"),
        kRemember_s);
  return true;
}

void Node::drain() {
  while (!waiting_.empty() && take(waiting_.front()) == Step::done) waiting_.pop_front();
}

Node::Step Node::take(Waiting& waiting) {
  if (!localization_.has_map()) {
    miss_map();
    ++scans_dropped_;
    return Step::done;
  }
  if (find_laser(waiting) == Step::wait || use_lasers() == Step::wait) return Step::wait;
  const auto laser = lasers_.find(waiting.message.frame_id);
  const bool is_known = laser != lasers_.end() && laser->second.mounted;
  if (!localization_.is_ready() || !is_known || !make_scan(waiting)) {
    ++scans_dropped_;
    return Step::done;
  }
  const Wheels wheels = find_wheels(waiting);
  if (wheels.step == Step::wait) return Step::wait;
  localize(*waiting.scan, wheels.odom_from_base);
  longest_ms_ = std::max(longest_ms_, 1e3 * (link_.steady_s() - waiting.since_s));
  return Step::done;
}

bool Node::make_scan(Waiting& waiting) {
  if (waiting.scan) return true;
  auto scan =
      Scan::make(upright(waiting.message, *lasers_[waiting.message.frame_id].mounted), gate_of(config_));
  if (!scan) {
    complain("sweep", Level::warn, "a scan is passed over: " + to_string(scan.error()), kRemember_s);
    return false;
  }
  waiting.scan = *std::move(scan);
  return true;
}

Node::Step Node::find_laser(const Waiting& waiting) {
  const std::string& frame = waiting.message.frame_id;
  if (!lasers_.contains(frame) && lasers_.size() == scan_topics_of(config_).size()) {
    std::string known;
    for (const auto& [name, laser] : lasers_) known += (known.empty() ? "\"" : ", \"") + name + "\"";
    complain("tf", Level::warn, "scans of \"" + frame + "\" are passed over: the laser is " + known,
             kRemember_s);
    return Step::done;
  }
  Laser& laser = lasers_[frame];
  if (laser.mounted) return Step::done;
  const TransformAnswer answer = has_base_from_laser_
                                     ? TransformAnswer{TransformAnswer::Kind::known,
                                                       transform_of(localization_.base_from_laser(frame)), ""}
                                     : link_.transform(config_.base_frame_id, frame, 0);
  if (answer.kind != TransformAnswer::Kind::known) {
    // Once: the scans of other lasers wait behind.
    if (!laser.was_waited_for && link_.steady_s() - waiting.since_s < kLaserWait_s) return Step::wait;
    laser.was_waited_for = true;
    complain(
        "tf " + frame, Level::error,
        "where the laser \"" + frame + "\" sits on \"" + config_.base_frame_id +
            "\" is not known, so its scans cannot be used: " + answer.why +
            " (publish it, as by static_transform_publisher, or set base_frame_id or ~base_from_laser/x_m)");
    return Step::done;
  }
  const auto mounted = mount(frame, answer.transform);
  if (!mounted) complain("tf " + frame, Level::error, to_string(mounted.error()));
  return Step::done;
}

Result<Done> Node::mount(const std::string& frame, const Transform& base_from_laser) {
  const auto mounted = mounted_laser(base_from_laser);
  if (!mounted) return mounted.error();
  lasers_[frame].mounted = *mounted;
  are_lasers_new_ = true;
  complaints_.clear("tf " + frame);
  if (mounted->tilt_rad > kTilted_rad)
    complain("laser " + frame, Level::warn,
             fmt::format("the laser is tilted by {:.1f} degrees; its scans are taken as level",
                         degrees(mounted->tilt_rad)));
  return Done{};
}

Node::Step Node::use_lasers() {
  if (!are_lasers_new_) return Step::done;
  std::vector<LaserOnRobot> all;
  for (const auto& [name, laser] : lasers_)
    if (laser.mounted) all.push_back({name, laser.mounted->base_from_laser});
  if (all.size() < scan_topics_of(config_).size() && link_.steady_s() - *first_heard_s_ < kAllLasersWait_s)
    return Step::wait;
  if (auto set = localization_.set_lasers(all); set)
    are_lasers_new_ = false;  // else the next scan tries again: there may be a better map by then
  else
    complain("map", Level::error, to_string(set.error()));
  return Step::done;
}

Node::Wheels Node::find_wheels(const Waiting& waiting) {
  if (config_.odom_frame_id.empty()) return {};
  // Where the base was at the scan's first beam, whatever the message's stamp means.
  const auto answer = link_.transform(config_.odom_frame_id, config_.base_frame_id, waiting.scan->stamp().ns);
  if (answer.kind == TransformAnswer::Kind::known) {
    const auto pose = pose_of(answer.transform);
    if (pose) {
      has_seen_wheels_ = true;
      complaints_.clear("odometry");
      return {Step::done, *pose};
    }
    complain("odometry", Level::warn, to_string(pose.error()), kRemember_s);
    return {};
  }
  if (answer.kind == TransformAnswer::Kind::not_yet) {
    has_seen_wheels_ = true;
    if (link_.steady_s() - waiting.since_s < config_.transform_wait) return {Step::wait, std::nullopt};
  }
  if (has_seen_wheels_)
    complain("odometry", Level::warn,
             "\"" + config_.odom_frame_id + "\" to \"" + config_.base_frame_id +
                 "\" is not known at a scan's stamp; localized without it, and no tf is sent: " + answer.why,
             kRemember_s);
  return {};
}

void Node::localize(const Scan& scan, const std::optional<Pose2>& odom_from_base) {
  if (!first_scan_) first_scan_ = scan.stamp();
  // Scans of several lasers may overtake each other a little; wheels that ran backwards would begin anew.
  if (odom_from_base && (!last_wheels_ || *last_wheels_ < scan.stamp())) {
    localization_.update(Odometry{scan.stamp(), *odom_from_base, std::nullopt, config_.odom_frame_id});
    last_wheels_ = scan.stamp();
  }
  const auto before = localization_.last();
  const PoseEstimate estimate = localization_.update(scan);
  tell(before, estimate, scan, odom_from_base);
}

void Node::tell(const std::optional<PoseEstimate>& before, const PoseEstimate& estimate, const Scan& scan,
                const std::optional<Pose2>& odom_from_base) {
  const std::string& frame = config_.global_frame_id;
  link_.send_places(places_message(estimate, localization_.candidates(), frame));
  if (link_.wants_beams())
    link_.send_beams(
        beams_message(before, estimate, scan, localization_.base_from_laser(scan.frame_id()), frame));
  if (auto saved = memory_.update(estimate); !saved)
    complain("pose_file", Level::warn, to_string(saved.error()), kRemember_s);
  log_change(estimate);
  // A pose that is not known is not told: whoever drives by it stops. Nor one that no scan has confirmed yet.
  if (!is_known(estimate)) return;
  link_.send_pose(pose_message(estimate, frame));
  tell_tf(estimate, odom_from_base);
  grow_path(estimate);
}

void Node::tell_tf(const PoseEstimate& estimate, const std::optional<Pose2>& odom_from_base) {
  if (!config_.tf_broadcast) return;
  if (estimate.stamp.ns <= last_tf_ns_) return;  // of two lasers at one moment: tf refuses a repetition
  const double now_s = link_.steady_s();
  const bool has_wheels = has_seen_wheels_ || odom_from_base;
  const std::string& child = has_wheels ? config_.odom_frame_id : config_.base_frame_id;
  if (const auto rival = tf_rivals_.beside(child, now_s))
    complain("tf tree", Level::error, *rival, kRemember_s);
  if (const auto loop = tf_rivals_.loop(child, now_s))
    return complain("tf tree", Level::error, *loop, kRemember_s);
  TransformMessage message{(estimate.stamp + config_.transform_tolerance).ns, config_.global_frame_id,
                           config_.base_frame_id, transform_of(estimate.map_from_base)};
  if (odom_from_base) {
    message.child_frame_id = config_.odom_frame_id;
    message.transform = transform_of(estimate.map_from_base * odom_from_base->inverse());
  } else {
    // A base with two parents would be worse than one that is not known for a moment.
    const bool may_come =
        !config_.odom_frame_id.empty() && seconds_between(*first_scan_, estimate.stamp) < kWheelsMayCome_s;
    if (has_seen_wheels_ || may_come) return;
  }
  link_.send_transform(message);
  last_tf_ns_ = estimate.stamp.ns;
}

bool Node::is_known(const PoseEstimate& estimate) const {
  return estimate.ok() || (estimate.status == Status::degraded && localization_.is_confirmed());
}

// What the log is looked through for: when the robot was found, when it was lost and why.
void Node::log_change(const PoseEstimate& estimate) {
  const bool is_found = is_known(estimate);
  if (is_found == was_found_ || (!was_found_ && estimate.status != Status::lost && !is_found)) return;
  was_found_ = is_found;
  const Pose2& at = estimate.map_from_base;
  if (is_found)
    link_.log(Level::ok, fmt::format("{} at x {:.3f} m, y {:.3f} m, {:.1f} degrees",
                                     to_string(estimate.status), at.x_m, at.y_m, degrees(at.theta_rad)));
  else
    link_.log(Level::warn, fmt::format("{}: {}", to_string(estimate.status), estimate.reason));
}

void Node::grow_path(const PoseEstimate& estimate) {
  if (!estimate.ok()) return;
  const Pose2& at = estimate.map_from_base;
  if (!path_.poses.empty() &&
      std::hypot(at.x_m - path_.poses.back().x_m, at.y_m - path_.poses.back().y_m) < kPathStep_m)
    return;
  if (path_.poses.size() == kLongestPath)
    path_.poses.erase(path_.poses.begin(), path_.poses.begin() + kLongestPath / 2);
  path_.stamp_ns = estimate.stamp.ns;
  path_.poses.push_back(transform_of(at));
  is_path_new_ = true;
}

}  // namespace beaconless::ros1
