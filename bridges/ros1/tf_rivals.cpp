// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/tf_rivals.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

namespace beaconless::ros1 {
namespace {

constexpr double kRemember_s = 10.0;

// Frames of before tf2 begin with a slash.
std::string bare(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

}  // namespace

TfRivals::TfRivals(std::string map_frame, std::string odom_frame, std::string base_frame)
    : map_frame_(std::move(map_frame)),
      odom_frame_(std::move(odom_frame)),
      base_frame_(std::move(base_frame)) {}

void TfRivals::hear(const TransformMessage& told, const std::string& teller, bool is_static, double now_s) {
  const std::string child = bare(told.child_frame_id);
  if (child.empty() || (child != map_frame_ && child != odom_frame_ && child != base_frame_)) return;
  const double until_s = is_static ? std::numeric_limits<double>::infinity() : now_s + kRemember_s;
  told_[child] = {bare(told.frame_id), teller, until_s};
}

const TfRivals::Told* TfRivals::of(const std::string& child, double now_s) const {
  const auto at = told_.find(child);
  return at == told_.end() || at->second.until_s < now_s ? nullptr : &at->second;
}

std::optional<std::string> TfRivals::loop(double now_s) const {
  const Told* told = of(map_frame_, now_s);
  if (told == nullptr || (told->parent != odom_frame_ && told->parent != base_frame_)) return std::nullopt;
  return fmt::format(
      "{} tells \"{}\" below \"{}\"; with this node's transform that would be a loop, so none is sent: end "
      "it, or take "
      "that transform out of the recording",
      told->teller, map_frame_, told->parent);
}

std::optional<std::string> TfRivals::beside(const std::string& child, double now_s) const {
  const Told* told = of(child, now_s);
  if (told == nullptr) return std::nullopt;
  const std::string both =
      fmt::format("{} tells \"{}\" below \"{}\", and this node below \"{}\": ", told->teller, child,
                  told->parent, map_frame_);
  if (child == base_frame_ && told->parent != map_frame_)
    return both + "if those are the wheels, set odom_frame_id to \"" + told->parent + "\"";
  return both + "end the other, take its transform out of the recording, or set tf_broadcast to false";
}

}  // namespace beaconless::ros1
