// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/inspect.hpp"

namespace beaconless::io {
namespace {

using Weight = Finding::Weight;
using Findings = std::vector<Finding>;

constexpr double kFewHits = 0.3;
constexpr double kManyInvalid = 0.2;
constexpr double kLongPath_m = 10.0;
constexpr double kDetour = 1.2;

double rounded(double value, double unit) { return std::round(value / unit) * unit + 0.0; }  // never -0

void look_at_stamps(const RecordingSummary& s, Findings& found) {
  if (s.repeated_stamps + s.backward_stamps > 0)
    found.push_back(
        {Weight::warning,
         fmt::format("{} scan stamps repeat and {} run backwards; the order of the file is kept",
                     s.repeated_stamps, s.backward_stamps),
         "speeds and the comparison with a reference by time mean little here; record with full stamps"});
  if (s.gaps > 0)
    found.push_back({Weight::note,
                     fmt::format("{} gaps between scans, the longest {:.2f} s at {:.2f} scans a second",
                                 s.gaps, s.longest_gap_s, s.rate_hz),
                     "a prediction across a gap is weak; expect to need a search there if the robot moved"});
  if (s.scans > 0 && !s.tells_beam_times)
    found.push_back({Weight::note, "no time per beam is told, so that a sweep counts as one moment",
                     "at 1 m/s a sweep of 0.1 s is bent by up to 0.1 m; tell it by --sweep-time, or record "
                     "time_increment"});
}

void look_at_ranges(const RecordingSummary& s, Findings& found) {
  if (s.capped_at_m)
    found.push_back(
        {Weight::warning,
         fmt::format("{:.1f} % of the beams end at {:.2f} m and almost none shortly before: the scanner's "
                     "word for nothing seen, counted as hits",
                     100.0 * s.capped_share, *s.capped_at_m),
         fmt::format("limit the range a little below, to {:.2f} m", 0.985 * *s.capped_at_m)});
  if (s.beams() > 0 && s.share(s.hits) < kFewHits)
    found.push_back({Weight::warning,
                     fmt::format("only {:.0f} % of the beams hit anything", 100.0 * s.share(s.hits)),
                     "check the range limits and whether anything covers the scanner"});
  if (s.share(s.invalid) > kManyInvalid)
    found.push_back(
        {Weight::warning,
         fmt::format("{:.0f} % of the beams carry no information (0, NaN)", 100.0 * s.share(s.invalid)),
         "many drivers write 0 for nothing seen; such beams are not used as free space"});
  if (s.least_beams != s.most_beams)
    found.push_back(
        {Weight::note, fmt::format("scans have from {} to {} beams", s.least_beams, s.most_beams), ""});
  if (s.scans > 0 && !std::isfinite(s.range_max_m))
    found.push_back({Weight::note, "no greatest range is told", "every finite range counts as a hit"});
}

void look_at_odometry(const PoseSource& source, double reference_m, Findings& found) {
  if (reference_m > kLongPath_m && source.path_length_m > kDetour * reference_m)
    found.push_back(
        {Weight::warning,
         fmt::format("odometry of {} goes {:.0f} m where the recorded poses go {:.0f} m: it jumps to and fro",
                     source.name, source.path_length_m, reference_m),
         "it was corrected afterwards, or its wheels slip; localize with the laser alone"});
  if (10 * source.moves_without_time > source.count)
    found.push_back({Weight::warning,
                     fmt::format("odometry of {} looks corrected: it moves {} times without any time passing",
                                 source.name, source.moves_without_time),
                     "do not take it for what wheels say; localize with the laser alone"});
  if (source.jumps > 0)
    found.push_back({Weight::warning,
                     fmt::format("odometry of {} jumps {} times, faster than 5 m/s or 10 rad/s", source.name,
                                 source.jumps),
                     "do not rely on it across the jumps"});
}

void look_at_reference(const PoseSource& source, Findings& found) {
  if (source.count > 1 && source.path_length_m == 0.0)
    found.push_back(
        {Weight::note,
         fmt::format("the poses of {} never move: they say nothing, or the robot stood", source.name), ""});
  if (!source.base_from_laser) return;
  const Pose2& offset = *source.base_from_laser;
  if (source.is_base_from_laser_constant)
    found.push_back({Weight::note, fmt::format("{} tells where the laser sits on the robot", source.name),
                     fmt::format("--base-from-laser {:.3f},{:.3f},{:.1f}", rounded(offset.x_m, 1e-3),
                                 rounded(offset.y_m, 1e-3), rounded(degrees(offset.theta_rad), 0.1))});
  else
    found.push_back(
        {Weight::note,
         fmt::format("{} has laser and robot poses that are not rigidly connected", source.name),
         "one of them was corrected, or they are from different moments; take neither for the mounting"});
}

}  // namespace

std::vector<Finding> diagnose(const RecordingSummary& summary) {
  Findings found;
  if (summary.scans == 0)
    found.push_back(
        {Weight::warning, "there are no scans that could be read", "nothing can be localized with it"});
  if (summary.skipped_records > 0)
    found.push_back({Weight::warning, fmt::format("{} records were passed over", summary.skipped_records),
                     "each is named with its place while reading"});
  double reference_m = 0.0;
  for (const PoseSource& source : summary.references)
    reference_m = std::max(reference_m, source.path_length_m);
  look_at_stamps(summary, found);
  look_at_ranges(summary, found);
  for (const PoseSource& source : summary.odometry) look_at_odometry(source, reference_m, found);
  for (const PoseSource& source : summary.references) look_at_reference(source, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  return found;
}

}  // namespace beaconless::io
