// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_marks.hpp"

namespace beaconless::report {
namespace {

constexpr double kRing_px = 6.0;
constexpr double kSquare_px = 4.0;

std::string with(std::string_view classes, Colour colour) {
  return std::string(classes) + " " + std::string(to_string(colour));
}

}  // namespace

void draw_marks(Picture& picture, const WorldView& view, const MapMarks& marks) {
  PathData dots;
  bool is_any = false;
  for (const Eigen::Vector2d& point : marks.points) {
    if (!point.allFinite()) continue;
    is_any = true;
    const Eigen::Vector2d at = view(point);
    if (marks.mark == Mark::dots)
      dots.dot(at);
    else if (marks.mark == Mark::outline)
      picture.svg.circle(at, marks.radius_m * view.px_per_m, with("outline", marks.colour));
    else if (marks.mark == Mark::square)
      picture.svg.rect(at.array() - kSquare_px, at.array() + kSquare_px, with("marker", marks.colour));
    else
      picture.svg.circle(at, kRing_px, with("marker", marks.colour));
  }
  if (!dots.empty()) picture.svg.path(dots, with("dots", marks.colour));
  if (is_any) picture.legend.push_back({marks.name, marks.mark, marks.colour});
}

}  // namespace beaconless::report
