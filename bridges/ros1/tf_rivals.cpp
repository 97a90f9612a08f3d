// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/tf_rivals.hpp"

#include <limits>

#include <fmt/format.h>

namespace beaconless::ros1 {
namespace {

constexpr double kRemember_s = 10.0;
constexpr std::size_t kMostFrames = 10'000;  // more are not those of a robot

// Frames of before tf2 begin with a slash.
std::string bare(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

}  // namespace

TfRivals::TfRivals(std::string map_frame, std::string odom_frame, std::string base_frame)
    : map_frame_(std::move(map_frame)),
      odom_frame_(std::move(odom_frame)),
      base_frame_(std::move(base_frame)) {}

void TfRivals::hear(const TransformMessage& told, const std::string& teller, bool is_static, double now_s) {
  const std::string child = bare(told.child_frame_id);
  const std::string parent = bare(told.frame_id);
  if (child.empty() || parent.empty() || child == parent || told_.size() > kMostFrames) return;
  const double until_s = is_static ? std::numeric_limits<double>::infinity() : now_s + kRemember_s;
  told_[child][teller] = {parent, is_static, until_s};
}

const TfRivals::ByTeller& TfRivals::of(const std::string& child) const {
  static const ByTeller kNobody;
  const auto at = told_.find(child);
  return at == told_.end() ? kNobody : at->second;
}

bool TfRivals::leads_up(const std::string& from, const std::string& to, double now_s,
                        std::set<std::string>& seen) const {
  if (from == to) return true;
  if (!seen.insert(from).second) return false;
  for (const auto& [teller, told] : of(from))
    if (told.until_s >= now_s && leads_up(told.parent, to, now_s, seen)) return true;
  return false;
}

std::optional<std::string> TfRivals::loop(const std::string& child, double now_s) const {
  for (const auto& [teller, told] : of(map_frame_)) {
    std::set<std::string> seen;
    if (told.until_s < now_s || !leads_up(told.parent, child, now_s, seen)) continue;
    const std::string what = fmt::format(
        "{} tells \"{}\" below \"{}\"; with \"{}\" below \"{}\" that would be a loop, so this node sends "
        "none: ",
        teller, map_frame_, told.parent, child, map_frame_);
    return what + (told.is_static
                       ? "end it, and start everything again that heard it, for it was told as static"
                       : "end it, or take its transform out of the recording");
  }
  return std::nullopt;
}

std::optional<std::string> TfRivals::beside(const std::string& child, double now_s) const {
  for (const std::string& frame : {odom_frame_, base_frame_}) {
    const bool is_ours = frame == child;
    // Who else tells a parent of it: we, or the first of the others.
    std::string other = is_ours ? "this node" : "";
    std::string parent = is_ours ? map_frame_ : "";
    for (const auto& [teller, told] : of(frame)) {
      if (told.until_s < now_s) continue;
      if (other.empty()) {
        other = teller;
        parent = told.parent;
      }
      if (!is_ours && told.parent == parent) continue;
      const std::string both = fmt::format("{} tells \"{}\" below \"{}\", and {} below \"{}\": ", teller,
                                           frame, told.parent, other, parent);
      if (!is_ours || told.parent == map_frame_)
        return both +
               "end one of the two, take its transform out of the recording, or set tf_broadcast to false";
      return both +
             (told.is_static ? "if that is the robot's own frame, set base_frame_id to \""
                             : "if those are the wheels, set odom_frame_id to \"") +
             told.parent + "\"";
    }
  }
  return std::nullopt;
}

}  // namespace beaconless::ros1
