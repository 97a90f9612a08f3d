// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/contradictions.hpp"
#include "beaconless/report/run_figures.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

/// The places that fitted after a scan, numbered and weighed.
MapMarks ghosts_of(const CandidatePlaces& fitted, const RunClock& clock) {
  MapMarks marks;
  marks.name = grouped(fitted.place_count) + (fitted.place_count == 1 ? " place fits" : " places fit") +
               " at " + number(clock(fitted.stamp), 1) + " " + clock.unit();
  marks.colour = Colour::sky;
  for (std::size_t i = 0; i < fitted.places.size(); ++i) {
    const CandidatePlace& place = fitted.places[i];
    marks.points.push_back(place.map_from_base.translation());
    marks.headings_rad.push_back(place.map_from_base.theta_rad);
    marks.labels.push_back(std::to_string(i + 1) + ": " + number(100.0 * place.weight, 0) + " %");
  }
  return marks;
}

}  // namespace

std::vector<MapMarks> marks_of(const RunReport& report) {
  std::vector<MapMarks> marks;
  // 1. Where the map is contradicted.
  if (report.map && !report.good_scans.empty()) {
    Contradictions found = find_contradictions(*report.map, report.good_scans);
    if (!found.new_things.empty())
      marks.push_back({"beams that end where the map has nothing", std::move(found.new_things),
                       Colour::orange, Mark::dots});
    if (!found.missing_walls.empty())
      marks.push_back({"beams that would have to pass through a wall", std::move(found.missing_walls),
                       Colour::red, Mark::dots});
  }
  // 2. Where it may have been: at the first search, and at the end if it is not clear there.
  const RunClock clock(report);
  if (!report.places.empty()) marks.push_back(ghosts_of(report.places.front(), clock));
  if (report.places.size() > 1 && !report.estimates.empty() &&
      report.places.back().stamp == report.estimates.back().stamp)
    marks.push_back(ghosts_of(report.places.back(), clock));
  return marks;
}

}  // namespace beaconless::report
