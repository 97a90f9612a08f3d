// SPDX-License-Identifier: Apache-2.0
#include "evaluate_relations.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "beaconless/eval/relations.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/relations.hpp"

#include "tables.hpp"

namespace beaconless::cli {
namespace {

/// The stamps of a recording's scans.
Result<std::vector<Stamp>> scan_stamps(const RelationWords& words) {
  std::vector<Stamp> stamps;
  if (words.recording.empty()) return stamps;
  const auto recording = io::open_recording(words.recording, {.topic = words.topic});
  if (!recording) return recording.error();
  for (const Event& event : *recording)
    if (const auto* scan = std::get_if<Scan>(&event)) stamps.push_back(scan->stamp());
  if (stamps.empty()) return Error{words.recording, "the recording has no scans", ""};
  return stamps;
}

/// Where no relation found its poses: what there was to find, and what helps.
Error nothing_found(const RelationWords& words, const Trajectory& estimate,
                    const std::vector<PoseRelation>& relations, bool by_stamp) {
  const std::string what = "no relation has a pose at both of its ends";
  if (!by_stamp)
    return {words.relations, what,
            fmt::format("they count scans; {} holds {} poses: --recording tells which scan is whose",
                        words.estimate, estimate.size())};
  Stamp first = std::get<Stamp>(relations.front().from);
  Stamp last = first;
  for (const PoseRelation& relation : relations) {
    for (const PoseKey& end : {relation.from, relation.to}) {
      first = std::min(first, std::get<Stamp>(end));
      last = std::max(last, std::get<Stamp>(end));
    }
  }
  return {words.relations, what,
          fmt::format("they lie between {:.3f} s and {:.3f} s, the poses of {} between {:.3f} s and {:.3f} "
                      "s: --clock-offset says how far the relations' clock is ahead, --tolerance how near "
                      "a pose must be",
                      first.seconds(), last.seconds(), words.estimate, estimate.front().stamp.seconds(),
                      estimate.back().stamp.seconds())};
}

/// Relations that count scans are only read by poses that are one a scan: where they count further than there
/// are poses, scans were left out, and each index would find the pose of another scan.
std::optional<Error> scan_beyond(const RelationWords& words, const Trajectory& estimate,
                                 const std::vector<PoseRelation>& relations) {
  if (!words.recording.empty()) return std::nullopt;
  std::uint64_t last = 0;
  for (const PoseRelation& relation : relations)
    for (const PoseKey& end : {relation.from, relation.to})
      if (const auto* scan = std::get_if<std::uint64_t>(&end)) last = std::max(last, *scan);
  if (last < estimate.size()) return std::nullopt;
  return Error{
      words.relations,
      fmt::format("it counts scans up to {}, and {} holds {} poses", last, words.estimate, estimate.size()),
      "poses are not one a scan: give the scans' recording by --recording"};
}

}  // namespace

int evaluate_relations(const Console& console, const RelationWords& words, const Trajectory& estimate) {
  // 1. Read the relations, and which stamps the scans have that they may count.
  ProblemLog problems;
  const auto relations =
      io::read_relations(words.relations, [&](const io::Problem& problem) { problems.add(problem); });
  problems.report(console);
  if (!relations) return console.fail(relations.error());
  const bool by_stamp = std::holds_alternative<Stamp>(relations->front().from);
  auto stamps = by_stamp ? std::vector<Stamp>{} : scan_stamps(words);
  if (!stamps) return console.fail(stamps.error());
  // 2. Compare.
  const auto evaluation = eval::evaluate_relations(estimate, *relations,
                                                   {.tolerance_s = words.tolerance_s,
                                                    .clock_offset_s = words.clock_offset_s,
                                                    .scan_stamps = std::move(stamps.value())});
  if (const auto beyond = scan_beyond(words, estimate, *relations)) return console.fail(*beyond);
  if (evaluation.errors.empty()) return console.fail(nothing_found(words, estimate, *relations, by_stamp));
  // 3. Tell.
  console.say(fmt::format("{} relations, {} of them without a pose at one of their ends",
                          evaluation.relation_count, evaluation.without_pose_count));
  console.say(fmt::format("translation {:.4f} ± {:.4f} m, rotation {:.3f} ± {:.3f} deg",
                          evaluation.translation_m.mean, evaluation.translation_m.sd,
                          evaluation.rotation_deg.mean, evaluation.rotation_deg.sd));
  console.say(
      table_text({evaluation.translation_m, evaluation.rotation_deg}, "translation [m]", "rotation [deg]"));
  console.result({{"relations", evaluation.relation_count},
                  {"without_pose", evaluation.without_pose_count},
                  {"translation_m", to_json(evaluation.translation_m)},
                  {"rotation_deg", to_json(evaluation.rotation_deg)}});
  return exit_good;
}

}  // namespace beaconless::cli
