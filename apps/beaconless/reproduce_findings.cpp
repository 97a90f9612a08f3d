// SPDX-License-Identifier: Apache-2.0
// What beats what, in sentences that follow from the numbers.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "reproduce_tables.hpp"
#include "reproduction.hpp"

namespace beaconless::cli {
namespace {

constexpr std::size_t kWithoutDriving = 4;  // of reproduced_scenarios()
constexpr double kHeld_m = 0.05;
constexpr double kWrong_m = 0.10;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string against_the_printed(const Reproduction& r) {
  const Score score = score_of(r.comparisons);
  std::map<std::string, std::vector<std::string>> above;
  for (const Comparison& comparison : r.comparisons) {
    if (comparison.on(MapKind::tape) == nullptr) continue;
    std::string which;
    for (const Statistic statistic : {Statistic::mean, Statistic::rmse})
      if (!comparison.is_at_or_below(MapKind::tape, statistic))
        which += (which.empty() ? "" : " and ") + std::string(name_of(statistic));
    if (!which.empty())
      above[std::string(comparison.table->number)].push_back(
          fmt::format("{} ({})", comparison.row->method, which));
  }
  if (score.compared == 0) return "None of the methods of this run stands in the printed tables.";
  std::string text = fmt::format(
      "On tape-measured plans {} of {} printed means and RMSEs are met or undercut{}", score.at_or_below,
      score.compared,
      score.not_own == 0
          ? ""
          : fmt::format(", {} of them by methods that found few of the poses themselves", score.not_own));
  std::vector<std::string> exceptions;
  exceptions.reserve(above.size());
  for (const auto& [number, rows] : above)
    exceptions.push_back(fmt::format("in Table {} {}", number, joined(rows)));
  text += exceptions.empty() ? "." : "; above them are, " + joined(exceptions) + ".";
  const LuckOfTheTape luck = luck_of(r);
  if (luck.tapes > 0)
    text += fmt::format(
        " That is one tape: of the {} means {} are met here, and {:.0f} on average over {} other tapes of "
        "the "
        "same care.",
        luck.compared, luck.at_or_below, luck.elsewhere, luck.tapes);
  return text;
}

/// A method over the scenes in which nothing drives, each counting the same.
struct Pooled {
  double rmse_m = 0.0;
  bool has_coasted = false;  ///< through most of a scene: then the error is that of the start pose
  bool is_complete = true;
};

Pooled pooled(const Reproduction& r, std::string_view method, MapKind map) {
  Pooled all;
  double square = 0.0;
  for (const std::string_view scenario : reproduced_scenarios().first(kWithoutDriving)) {
    const Experiment* experiment = find(r.experiments, scenario, map, method);
    all.is_complete = all.is_complete && experiment != nullptr;
    if (experiment == nullptr) continue;
    square += std::pow(experiment->table.position_m.rmse, 2);
    all.has_coasted = all.has_coasted || 2 * experiment->ok_count < experiment->errors.size();
  }
  all.rmse_m = std::sqrt(square / static_cast<double>(kWithoutDriving));
  return all;
}

std::string on_exact_plans(const Reproduction& r) {
  std::vector<std::pair<double, std::string>> ranked;
  std::vector<std::string> coasted;
  for (const std::string& method : r.methods.present) {
    const Pooled all = pooled(r, method, MapKind::exact);
    if (all.is_complete && all.has_coasted) coasted.push_back(method);
    if (all.is_complete && !all.has_coasted) ranked.emplace_back(all.rmse_m, method);
  }
  if (ranked.empty()) return "Nothing ran on the exact plans.";
  std::ranges::sort(ranked);
  std::vector<std::string> words;
  words.reserve(ranked.size());
  for (const auto& [rmse_m, method] : ranked)
    words.push_back(fmt::format("{} {} mm", method, cell_mm(rmse_m)));
  const PublishedRow& full = published::kTable43.front();
  return fmt::format(
      "Without the tape's errors, standing and turning on the exact plans, the order by position RMSE is "
      "{}{}; {:.1f} % of the mean square of the printed full-scan ICP of Table 4.3 is a constant offset, so "
      "that the printed order tells of map and reference rather than of methods.",
      joined(words),
      coasted.empty()
          ? ""
          : ", not counting those that were not ok for most scans of a scene (" + joined(coasted) + ")",
      100.0 * (1.0 - std::pow(full.sd / full.rmse, 2)));
}

/// A method among people, on the exact plan.
struct AmongPeople {
  std::string method;
  double max_m = 0.0;
  double max_ok_m = 0.0;
  std::size_t not_ok_count = 0;
};

AmongPeople among_people(const Reproduction& r, const std::string& method) {
  AmongPeople all{.method = method};
  for (const Experiment& e : r.experiments) {
    if (e.method != method || e.map != MapKind::exact || !e.scenario.ends_with("people")) continue;
    all.max_m = std::max(all.max_m, e.table.position_m.max);
    all.max_ok_m = std::max(all.max_ok_m, e.max_ok_m);
    all.not_ok_count += e.degraded_count + e.lost_count;
  }
  return all;
}

std::string who_holds_among_people(const Reproduction& r) {
  std::vector<std::string> held;
  std::vector<std::string> left;
  std::vector<std::string> wrong;
  for (const std::string& method : r.methods.present) {
    const AmongPeople all = among_people(r, method);
    const std::string not_ok =
        all.not_ok_count == 0 ? "" : fmt::format(", {} scans not ok", all.not_ok_count);
    (all.max_m <= kHeld_m ? held : left)
        .push_back(fmt::format("{} ({} mm{})", method, cell_mm(all.max_m), not_ok));
    if (all.max_ok_m > kWrong_m) wrong.push_back(fmt::format("{} ({} mm)", method, cell_mm(all.max_ok_m)));
  }
  std::string text =
      "Among one and three people, on the exact plan, the largest error stays below 5 cm with ";
  text += held.empty() ? "no method" : joined(held);
  if (!left.empty()) text += ", but not with " + joined(left);
  return text + (wrong.empty() ? "; none says ok with an error above 10 cm."
                               : "; an error above 10 cm is called ok by " + joined(wrong) + ".");
}

}  // namespace

Score score_of(std::span<const Comparison> comparisons) {
  Score score;
  for (const Comparison& comparison : comparisons) {
    if (comparison.on(MapKind::tape) == nullptr) continue;
    for (const Statistic statistic : {Statistic::mean, Statistic::rmse}) {
      ++score.compared;
      if (!comparison.is_at_or_below(MapKind::tape, statistic)) continue;
      ++score.at_or_below;
      score.not_own += comparison.is_own(MapKind::tape) ? 0U : 1U;
    }
  }
  return score;
}

LuckOfTheTape luck_of(const Reproduction& reproduction) {
  LuckOfTheTape luck;
  for (const Comparison& comparison : reproduction.comparisons) {
    const TapeSpread* spread = find(reproduction.tapes, comparison.table->scenario, comparison.row->method);
    if (spread == nullptr || comparison.on(MapKind::tape) == nullptr) continue;
    const auto& means = spread->means(comparison.table->quantity);
    ++luck.compared;
    luck.at_or_below += comparison.is_at_or_below(MapKind::tape, Statistic::mean) ? 1U : 0U;
    luck.elsewhere += TapeSpread::share_up_to(means, comparison.row->mean);
    luck.tapes = std::max(luck.tapes, means.size());
  }
  return luck;
}

std::vector<std::string> findings_of(const Reproduction& reproduction) {
  return {against_the_printed(reproduction), on_exact_plans(reproduction),
          who_holds_among_people(reproduction)};
}

}  // namespace beaconless::cli
