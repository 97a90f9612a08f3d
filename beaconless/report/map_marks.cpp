// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_marks.hpp"

#include <cmath>

namespace beaconless::report {
namespace {

constexpr double kRing_px = 6.0;
constexpr double kSquare_px = 4.0;
constexpr double kHeading_px = 20.0;

std::string with(std::string_view classes, Colour colour) {
  return std::string(classes) + " " + std::string(to_string(colour));
}

/// The heading and the words of one point.
void draw_details(Picture& picture, const WorldView& view, const Eigen::Vector2d& at, std::size_t i,
                  const MapMarks& marks) {
  const bool looks = i < marks.headings_rad.size();
  const double theta_rad = looks ? marks.headings_rad[i] : 0.0;
  const Eigen::Vector2d ahead(std::cos(theta_rad), -std::sin(theta_rad));
  if (looks)
    picture.svg.line(at + kRing_px * ahead, at + kHeading_px * ahead, with("line thick", marks.colour));
  if (i >= marks.labels.size()) return;
  // To the side where there is less room, because draw_ends names start and end on the other.
  const bool below = ahead.y() < 0.0;
  const bool left = at.x() < 0.5 * (view.top_left_px.x() + view.bottom_right_px().x());
  picture.svg.text(at + Eigen::Vector2d(left ? -10.0 : 10.0, below ? 14.0 : -14.0), marks.labels[i],
                   left ? "tag end" : "tag", TextSide::middle);
}

}  // namespace

void draw_marks(Picture& picture, const WorldView& view, const MapMarks& marks) {
  PathData dots;
  bool is_any = false;
  for (std::size_t i = 0; i < marks.points.size(); ++i) {
    const Eigen::Vector2d& point = marks.points[i];
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
    draw_details(picture, view, at, i, marks);
  }
  if (!dots.empty()) picture.svg.path(dots, with("dots", marks.colour));
  if (is_any) picture.legend.push_back({marks.name, marks.mark, marks.colour});
}

}  // namespace beaconless::report
