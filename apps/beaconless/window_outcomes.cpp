// SPDX-License-Identifier: Apache-2.0
#include "window_outcomes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace beaconless::cli {
namespace {

constexpr std::array kOutcomes{Outcome::correct,  Outcome::wrong, Outcome::ambiguous,
                               Outcome::degraded, Outcome::lost,  Outcome::untold};
constexpr std::size_t kMostShown = 20;

double position_error_m(const Pose2& pose, const Pose2& truth) { return distance_m(pose, truth); }

double heading_error_deg(const Pose2& pose, const Pose2& truth) {
  return std::abs(degrees(wrap_angle(pose.theta_rad - truth.theta_rad)));
}

bool is_there(const Pose2& pose, const Pose2& truth) {
  return position_error_m(pose, truth) <= kCorrect_m && heading_error_deg(pose, truth) <= kCorrect_deg;
}

Outcome outcome_of(const WindowFound& found, const std::optional<Pose2>& truth) {
  switch (found.estimate.status) {
    case Status::ok:
      if (!truth) return Outcome::untold;
      return is_there(found.estimate.map_from_base, *truth) ? Outcome::correct : Outcome::wrong;
    case Status::relocalizing:
      return Outcome::ambiguous;
    case Status::degraded:
      return Outcome::degraded;
    case Status::lost:
      return Outcome::lost;
    case Status::not_started:
    case Status::not_a_scan:
      return Outcome::untold;
  }
  return Outcome::untold;
}

std::size_t count_of(const std::vector<JudgedWindow>& windows, Outcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(windows.begin(), windows.end(), [&](const auto& w) { return w.outcome == outcome; }));
}

std::size_t ambiguous_with_truth(const std::vector<JudgedWindow>& windows) {
  return static_cast<std::size_t>(std::count_if(windows.begin(), windows.end(), [](const auto& w) {
    return w.outcome == Outcome::ambiguous && w.is_among_candidates;
  }));
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::correct:
      return "correct";
    case Outcome::wrong:
      return "wrong";
    case Outcome::ambiguous:
      return "ambiguous";
    case Outcome::degraded:
      return "degraded";
    case Outcome::lost:
      return "lost";
    case Outcome::untold:
      return "untold";
  }
  return "unknown";
}

std::vector<JudgedWindow> judge_windows(const std::vector<WindowFound>& found, const PosesOf* reference) {
  std::vector<JudgedWindow> windows;
  for (const WindowFound& window : found) {
    JudgedWindow& judged = windows.emplace_back();
    judged.found = window;
    if (reference != nullptr) judged.truth = reference->at(window.last_scan, window.estimate.stamp);
    judged.outcome = outcome_of(window, judged.truth);
    judged.is_among_candidates =
        judged.truth &&
        std::any_of(window.candidates.begin(), window.candidates.end(),
                    [&](const PoseCandidate& c) { return is_there(c.map_from_base, *judged.truth); });
  }
  return windows;
}

nlohmann::json summary_of(const std::vector<JudgedWindow>& windows, const Windows& asked) {
  nlohmann::json outcomes;
  for (const Outcome outcome : kOutcomes)
    outcomes[std::string(to_string(outcome))] = count_of(windows, outcome);
  nlohmann::json wrong = nlohmann::json::array();
  std::vector<double> took_ms;
  for (const JudgedWindow& w : windows) {
    took_ms.push_back(1e-3 * w.found.took_us);
    if (w.outcome != Outcome::wrong) continue;
    wrong.push_back({{"scan", w.found.last_scan},
                     {"stamp", to_string(w.found.estimate.stamp)},
                     {"position_m", position_error_m(w.found.estimate.map_from_base, *w.truth)},
                     {"heading_deg", heading_error_deg(w.found.estimate.map_from_base, *w.truth)},
                     {"quality", w.found.estimate.quality}});
  }
  std::sort(took_ms.begin(), took_ms.end());
  return {{"length", asked.length},
          {"stride", asked.stride},
          {"count", windows.size()},
          {"outcomes", outcomes},
          {"ambiguous_with_truth", ambiguous_with_truth(windows)},
          {"wrong", wrong},
          {"took_ms",
           {{"median", took_ms.empty() ? 0.0 : took_ms[took_ms.size() / 2]},
            {"max", took_ms.empty() ? 0.0 : took_ms.back()}}}};
}

std::vector<std::string> lines_of(const std::vector<JudgedWindow>& windows, bool has_reference) {
  if (!has_reference) return {};
  std::string counts;
  for (const Outcome outcome : kOutcomes) {
    const std::size_t count = count_of(windows, outcome);
    if (count > 0 || outcome == Outcome::correct || outcome == Outcome::wrong)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, to_string(outcome));
  }
  std::vector<std::string> lines{fmt::format("{} windows: {}", windows.size(), counts)};
  if (const std::size_t ambiguous = count_of(windows, Outcome::ambiguous); ambiguous > 0)
    lines.push_back(fmt::format("  of the {} ambiguous, the right place is among those that fit in {}",
                                ambiguous, ambiguous_with_truth(windows)));
  std::size_t told = 0;
  for (const JudgedWindow& w : windows) {
    if (w.outcome != Outcome::wrong || told++ >= kMostShown) continue;
    lines.push_back(fmt::format(
        "  wrong but ok: scan {} at {} s, {:.2f} m and {:.1f} deg off, quality {:.2f}", w.found.last_scan,
        to_string(w.found.estimate.stamp), position_error_m(w.found.estimate.map_from_base, *w.truth),
        heading_error_deg(w.found.estimate.map_from_base, *w.truth), w.found.estimate.quality));
  }
  if (told > kMostShown)
    lines.push_back(fmt::format("  … and {} more; windows.csv has all", told - kMostShown));
  return lines;
}

std::string csv_of(const std::vector<JudgedWindow>& windows) {
  std::string text =
      "first_scan,last_scan,stamp,x_m,y_m,theta_rad,status,quality,outcome,position_error_m,"
      "heading_error_deg,candidates,took_ms\n";
  for (const JudgedWindow& w : windows) {
    const PoseEstimate& e = w.found.estimate;
    const Pose2& pose = e.map_from_base;
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},", w.found.first_scan, w.found.last_scan, to_string(e.stamp),
                    pose.x_m, pose.y_m, pose.theta_rad, to_string(e.status), e.quality, to_string(w.outcome));
    if (w.truth)
      text += fmt::format("{},{},", position_error_m(pose, *w.truth), heading_error_deg(pose, *w.truth));
    else
      text += ",,";
    text += fmt::format("{},{:.3f}\n", w.found.candidates.size(), 1e-3 * w.found.took_us);
  }
  return text;
}

}  // namespace beaconless::cli
