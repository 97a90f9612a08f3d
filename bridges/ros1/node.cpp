// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/node.hpp"

#include <utility>

#include <fmt/format.h>

#include "bridges/ros1/grid_of_message.hpp"
#include "bridges/ros1/start_guess.hpp"
#include "bridges/ros1/told.hpp"

namespace beaconless::ros1 {
namespace {

constexpr double kTell_s = 1.0;    // from one diagnostic to the next
constexpr double kNoScan_s = 2.0;  // without a scan something is wrong …
constexpr double kNoMap_s = 2.0;   // … and without a map

}  // namespace

Node::Node(const Settings& settings, Link& link, Localization::Maker maker)
    : config_(settings.node),
      has_initial_pose_(settings.has_initial_pose),
      has_base_from_laser_(settings.has_base_from_laser),
      link_(link),
      localization_(settings.localizer, std::move(maker)),
      memory_(settings.node.pose_file),
      tf_rivals_(config_.global_frame_id, config_.odom_frame_id, config_.base_frame_id),
      begun_s_(link.steady_s()) {
  path_.frame_id = config_.global_frame_id;
}

Handlers Node::handlers() {
  return {
      .on_scan = [this](const ScanMessage& scan) { hear_scan(scan); },
      .on_initial_pose = [this](const PoseMessage& pose) { hear_initial_pose(pose); },
      .on_map = [this](const GridMessage& grid) { hear_map(grid); },
      .on_transform_of_other = [this](const TransformMessage& told, const std::string& teller,
                                      bool is_static) { hear_transform_of_other(told, teller, is_static); },
      .on_new_master = [this] { hear_new_master(); },
      .on_set_map = [this](const GridMessage& grid,
                           const PoseMessage& pose) { return serve_set_map(grid, pose); },
      .on_global_localization = [this] { return serve_global_localization(); },
      .on_request_nomotion_update = [this] { return serve_nomotion_update(); },
      .on_save_pose = [this] { return serve_save_pose(); },
      .on_tick = [this] { tick(); }};
}

void Node::complain(const std::string& subject, Level level, const std::string& words, double lasts_s) {
  if (complaints_.raise(subject, level, words, link_.steady_s(), lasts_s))
    link_.log(level, subject + ": " + words);
}

// What was told before the first map, the start of the parameters, the one that was remembered, or none.
void Node::start() {
  if (early_pose_) hear_initial_pose(*std::exchange(early_pose_, std::nullopt));
  if (has_initial_pose_ && !localization_.has_start()) {
    PoseMessage pose{0,
                     config_.global_frame_id,
                     transform_of({config_.initial_pose_x, config_.initial_pose_y, config_.initial_pose_a}),
                     {}};
    pose.covariance[0] = config_.initial_cov_xx;
    pose.covariance[7] = config_.initial_cov_yy;
    pose.covariance[35] = config_.initial_cov_aa;
    hear_initial_pose(pose);
  }
  if (localization_.has_start()) return;
  const auto remembered = memory_.recall();
  if (!remembered) complain("pose_file", Level::warn, to_string(remembered.error()));
  if (remembered && *remembered) {
    link_.log(Level::ok, fmt::format("starting where the robot was when {} was written", config_.pose_file));
    localization_.start_at(**remembered);
  } else if (config_.start == "auto") {
    search_everywhere();
  }
}

void Node::search_everywhere() {
  link_.log(Level::ok, "looking for the robot on the whole map");
  was_found_.reset();
  localization_.start_anywhere();
}

Result<Done> Node::set_map(Map map, const io::MapIdentity& identity) {
  const auto message = message_of_map(map, config_.global_frame_id);
  if (!message) return message.error();
  if (auto used = use_map(std::move(map), identity); !used) return used.error();
  link_.send_map(*message);
  return Done{};
}

Result<Done> Node::use_map(Map map, const io::MapIdentity& identity) {
  const bool is_first = !localization_.has_map();
  if (auto set = localization_.set_map(std::make_shared<const Map>(std::move(map))); !set) return set.error();
  complaints_.clear("map");
  memory_.set_map(identity);
  link_.log(Level::ok, "map: " + words_of_map(*localization_.map()));
  if (is_first && (early_pose_ || !localization_.has_start())) start();
  return Done{};
}

Result<Done> Node::take_grid(OccupancyGrid grid, const std::string& frame) {
  if (frame != config_.global_frame_id && frame != "/" + config_.global_frame_id)
    link_.log(Level::warn, "map: its frame is \"" + frame + "\"; poses are told in \"" +
                               config_.global_frame_id + "\" (global_frame_id)");
  // A map server that was started again brings the same map.
  if (const Map* known = localization_.map(); known != nullptr && *known == Map(grid)) return Done{};
  const auto identity = identify_grid(grid);
  return config_.map_file.empty() ? use_map(std::move(grid), identity) : set_map(std::move(grid), identity);
}

void Node::hear_map(const GridMessage& grid) {
  if (!config_.map_file.empty() || (config_.first_map_only && localization_.has_map())) return;
  auto taken = grid_of_message(grid);
  const Result<Done> done = taken ? take_grid(*std::move(taken), grid.frame_id) : taken.error();
  if (!done) complain("map", Level::error, to_string(done.error()));
}

void Node::hear_new_master() { tf_rivals_.forget(); }

void Node::hear_transform_of_other(const TransformMessage& told, const std::string& teller, bool is_static) {
  tf_rivals_.hear(told, teller, is_static, link_.steady_s());
}

void Node::hear_initial_pose(const PoseMessage& pose) {
  const auto refuse = [this](const Error& why) {
    const std::string words = "refused: " + to_string(why);
    complaints_.raise("initialpose", Level::warn, words, link_.steady_s(), kRemember_s);
    link_.log(Level::warn, "initialpose: " + words);  // each, for somebody is waiting for it
  };
  const auto guess = start_guess_of(pose, config_.global_frame_id);
  if (!guess) return refuse(guess.error());
  if (!localization_.has_map()) {
    early_pose_ = pose;
    return;
  }
  if (auto on_map = check_on_map(*guess, *localization_.map()); !on_map) return refuse(on_map.error());
  complaints_.clear("initialpose");
  was_found_.reset();
  const Pose2& at = guess->map_from_base;
  link_.log(Level::ok, fmt::format("{} x {:.3f} m, y {:.3f} m, {:.1f} degrees",
                                   guess->within ? "searching around" : "starting at", at.x_m, at.y_m,
                                   degrees(at.theta_rad)));
  if (guess->within) {
    localization_.start_anywhere(guess->within);
  } else {
    localization_.start_at(at);
  }
}

Answer Node::serve_set_map(const GridMessage& grid, const PoseMessage& pose) {
  const auto guess = start_guess_of(pose, config_.global_frame_id);
  if (!guess) return {false, to_string(guess.error())};
  auto map = grid_of_message(grid);
  if (!map) return {false, to_string(map.error())};
  if (auto on_map = check_on_map(*guess, *map); !on_map) return {false, to_string(on_map.error())};
  const bool is_first = !localization_.has_map();
  if (is_first) early_pose_ = pose;  // and the first map begins there
  if (auto taken = take_grid(*std::move(map), grid.frame_id); !taken)
    return {false, to_string(taken.error())};
  if (!is_first) hear_initial_pose(pose);
  return {true, ""};
}

Answer Node::serve_global_localization() {
  early_pose_.reset();
  search_everywhere();
  return {true, "looking on the whole map"};
}

Answer Node::serve_nomotion_update() const { return {true, "every scan is an update, moving or not"}; }

Answer Node::serve_save_pose() {
  const auto& last = localization_.last();
  if (!last || !last->is_trusted())
    return {false, "there is no pose that deserves trust: " +
                       (last ? fmt::format("{}, quality {:.2f}", to_string(last->status), last->quality)
                             : std::string("no scan was localized yet"))};
  link_.keep_parameter("initial_pose_x", last->map_from_base.x_m);
  link_.keep_parameter("initial_pose_y", last->map_from_base.y_m);
  link_.keep_parameter("initial_pose_a", last->map_from_base.theta_rad);
  if (auto written = memory_.finish(); !written) return {false, to_string(written.error())};
  return {true, config_.pose_file.empty() ? "kept as initial_pose_x, _y and _a"
                                          : "kept as initial_pose_x, _y and _a, and in " + config_.pose_file};
}

void Node::look_after_scans(double now_s) {
  const std::size_t topics = scan_topics_of(config_).size();
  if (heard_s_.empty() && now_s - begun_s_ > kNoScan_s)
    complain(
        "scan", Level::error,
        fmt::format("no scan for {:.0f} s; is the topic right, is its driver running?", now_s - begun_s_));
  else if (!heard_s_.empty() && heard_s_.size() < topics && now_s - *first_heard_s_ > kNoScan_s)
    complain("scan", Level::error,
             fmt::format("scans of {} of {} lasers are heard; are all topics of ~scan_topics right?",
                         heard_s_.size(), topics));
  else if (!heard_s_.empty())
    complaints_.clear("scan");
  for (const auto& [frame, heard_s] : heard_s_) {
    const std::string subject = "scan " + frame;
    if (now_s - heard_s > kNoScan_s)
      complain(subject, Level::error,
               fmt::format("no scan{} for {:.0f} s; is its driver running?",
                           topics > 1 ? " of \"" + frame + "\"" : std::string(), now_s - heard_s));
    else
      complaints_.clear(subject);
  }
}

void Node::miss_map() {
  complain("map", Level::error, "there is no map yet: neither on the topic map nor by ~map_file");
}

void Node::tick() {
  drain();
  const double now_s = link_.steady_s();
  if (now_s - last_told_s_ < kTell_s) return;
  last_told_s_ = now_s;
  look_after_scans(now_s);
  if (!localization_.has_map() && now_s - begun_s_ > kNoMap_s) miss_map();
  DiagnosticMessage diagnostic = diagnostic_message(localization_.last(), complaints_.at(now_s));
  diagnostic.values.emplace_back("method", localization_.method());
  for (const LaserSays& laser : localization_.lasers())
    diagnostic.values.emplace_back("laser " + std::string(laser.frame_id),
                                   std::string(to_string(laser.estimate.status)) +
                                       (laser.estimate.reason.empty() ? "" : ": ") +
                                       std::string(laser.estimate.reason));
  diagnostic.values.emplace_back("scans_heard", std::to_string(scans_heard_));
  diagnostic.values.emplace_back("scans_dropped", std::to_string(scans_dropped_));
  diagnostic.values.emplace_back("longest_ms", fmt::format("{:.2f}", longest_ms_));
  longest_ms_ = 0.0;
  link_.send_diagnostic(diagnostic);
  if (is_path_new_) link_.send_path(path_);
  is_path_new_ = false;
}

}  // namespace beaconless::ros1
