// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/splice.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/trust/retimed.hpp"

namespace beaconless::trust {
namespace {

/// Where the scans of a trial are among its events.
std::vector<std::size_t> places_of_scans(const Trial& trial) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < trial.events.size(); ++i)
    if (std::holds_alternative<Scan>(trial.events[i])) places.push_back(i);
  return places;
}

/// The events of a part: from its first scan to its last.
std::vector<Event> events_of(const TrialPart& part) {
  const std::vector<std::size_t> places = places_of_scans(*part.of);
  const auto begin = part.of->events.begin();
  return {begin + static_cast<std::ptrdiff_t>(places[part.first]),
          begin + static_cast<std::ptrdiff_t>(places[part.end - 1] + 1)};
}

std::int64_t typical_period_ns(const std::vector<Event>& events) {
  std::vector<std::int64_t> periods;
  std::optional<Stamp> last;
  for (const Event& event : events) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    if (last) periods.push_back(scan->stamp().ns - last->ns);
    last = scan->stamp();
  }
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

std::optional<Pose2> last_odometry(const std::vector<Event>& events) {
  std::optional<Pose2> last;
  for (const Event& event : events)
    if (const auto* odometry = std::get_if<Odometry>(&event)) last = odometry->odom_from_base;
  return last;
}

/// Moves events in time, and their odometry so that it goes on from another.
void carry_on(std::vector<Event>& events, std::int64_t later_ns, const std::optional<Pose2>& odom_from_base) {
  std::optional<Pose2> odom_from_told;
  for (Event& event : events) {
    if (auto* scan = std::get_if<Scan>(&event)) {
      *scan = retimed(*scan, {scan->stamp().ns + later_ns});
    } else if (auto* odometry = std::get_if<Odometry>(&event)) {
      odometry->stamp.ns += later_ns;
      if (!odom_from_told && odom_from_base)
        odom_from_told = *odom_from_base * odometry->odom_from_base.inverse();
      if (odom_from_told) odometry->odom_from_base = *odom_from_told * odometry->odom_from_base;
    } else {
      std::get<ReferencePose>(event).stamp.ns += later_ns;
    }
  }
}

}  // namespace

Trial splice(const TrialPart& before, const TrialPart& after) {
  Trial spliced = *before.of;
  spliced.events = events_of(before);
  std::vector<Event> carried = events_of(after);
  const Stamp next{stamp_of(spliced.events.back()).ns + typical_period_ns(spliced.events)};
  carry_on(carried, next.ns - stamp_of(carried.front()).ns, last_odometry(spliced.events));
  spliced.events.insert(spliced.events.end(), carried.begin(), carried.end());
  spliced.truth.clear();
  for (const TrialPart& part : {before, after})
    for (std::size_t i = part.first; i < part.end; ++i) spliced.truth.push_back(part.of->truth[i]);
  spliced.starts = {{0, spliced.truth.front()}};
  return spliced;
}

const Scan& scan_of(const Trial& trial, std::size_t i) {
  std::size_t scan = 0;
  for (const Event& event : trial.events)
    if (std::holds_alternative<Scan>(event) && scan++ == i) return std::get<Scan>(event);
  throw std::out_of_range("a trial has no such scan");
}

}  // namespace beaconless::trust
