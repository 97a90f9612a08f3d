// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/scan_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "beaconless/report/covariance_ellipse.hpp"
#include "beaconless/report/text.hpp"
#include "beaconless/report/world_frame.hpp"

namespace beaconless::report {
namespace {

constexpr std::array<Colour, 5> kTurns{Colour::blue, Colour::orange, Colour::green, Colour::purple,
                                       Colour::sky};
constexpr double kArrow_px = 16.0;
constexpr double kTick_px = 4.0;
constexpr double kLargestScale_m = 1.0;  // the support of a step between two rooms would cover both
constexpr double kLeastEllipse_px = 1.5;

/// The sensor, all hits and all corners, with a little room around them.
Eigen::AlignedBox2d bounds_of(const Scan& scan, const ScanLayers& layers) {
  Eigen::AlignedBox2d bounds(Eigen::Vector2d::Zero());
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) bounds.extend(scan.point(beam));
  for (const Corner& corner : layers.corners) bounds.extend(corner.point);
  const double room = 0.03 * bounds.sizes().maxCoeff() + 0.1;
  bounds.min().array() -= room;
  bounds.max().array() += room;
  return bounds;
}

std::string with(std::string_view classes, Colour colour) {
  return std::string(classes) + " " + std::string(to_string(colour));
}

/// "1 line", "2 lines".
std::string counted(std::size_t count, const std::string& noun) {
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

void draw_hits(Picture& picture, const WorldView& view, const Scan& scan, const ScanLayers& layers) {
  // 1. which segment each beam belongs to
  std::vector<std::size_t> owner(scan.size(), kTurns.size());
  for (std::size_t s = 0; s < layers.segments.size(); ++s)
    for (std::size_t k = 0; k < layers.segments[s].count; ++k)
      owner[layers.segments[s].beam(k, scan.size())] = s % kTurns.size();
  // 2. one path a colour; grey for those of no segment
  for (std::size_t turn = 0; turn <= kTurns.size(); ++turn) {
    PathData dots;
    for (std::size_t beam = 0; beam < scan.size(); ++beam)
      if (scan.is_hit(beam) && owner[beam] == turn) dots.dot(view(scan.point(beam)));
    if (!dots.empty())
      picture.svg.path(dots, with("dots", turn < kTurns.size() ? kTurns[turn] : Colour::grey));
  }
  picture.legend.push_back(
      {counted(scan.hit_count(), "beam") + " that hit something", Mark::dots, Colour::grey});
  if (!layers.segments.empty())
    picture.legend.push_back(
        {counted(layers.segments.size(), "segment") + ", neighbours in different colours", Mark::dots,
         Colour::blue});
}

void draw_sensor(Picture& picture, const WorldView& view) {
  const Eigen::Vector2d at = view({0, 0});
  picture.svg.circle(at, 6.0, with("marker", Colour::ink));
  picture.svg.line(at, at + Eigen::Vector2d(22.0, 0.0), with("line thick", Colour::ink));
  picture.legend.push_back({"the scanner, looking along x", Mark::ring, Colour::ink});
}

/// A line is drawn with a tick at both ends, thin enough to leave the colours of its beams to be seen.
void draw_lines(Picture& picture, const WorldView& view, const ScanLayers& layers) {
  if (layers.lines.empty()) return;
  for (const ScanLine& line : layers.lines) {
    const Eigen::Vector2d a = view(line.a);
    const Eigen::Vector2d b = view(line.b);
    const Eigen::Vector2d across = kTick_px * Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
    picture.svg.line(a, b, with("line", Colour::ink));
    for (const Eigen::Vector2d& end : {a, b})
      picture.svg.line(end - across, end + across, with("line", Colour::ink));
  }
  picture.legend.push_back({counted(layers.lines.size(), "line"), Mark::thin, Colour::ink});
}

void draw_circles(Picture& picture, const WorldView& view, const ScanLayers& layers) {
  if (layers.circles.empty()) return;
  for (const ScanCircle& circle : layers.circles)
    picture.svg.circle(view(circle.fit.circle.centre), circle.fit.circle.radius_m * view.px_per_m,
                       with("outline", Colour::green));
  picture.legend.push_back({counted(layers.circles.size(), "circle"), Mark::outline, Colour::green});
}

/// A short line from a point along a direction of the sensor frame.
void draw_direction(Svg& svg, const Eigen::Vector2d& at_px, double angle_rad, Colour colour) {
  const Eigen::Vector2d along(std::cos(angle_rad), -std::sin(angle_rad));
  svg.line(at_px, at_px + kArrow_px * along, with("line", colour));
}

void draw_corners(Picture& picture, const WorldView& view, const ScanLayers& layers, double sigma_count) {
  if (layers.corners.empty()) return;
  bool ellipses = false;
  for (const Corner& corner : layers.corners) {
    const Eigen::Vector2d at = view(corner.point);
    const Ellipse ellipse = covariance_ellipse(corner.covariance, sigma_count);
    if (ellipse.major_m * view.px_per_m >= kLeastEllipse_px) {
      picture.svg.ellipse(at, view.px_per_m * Eigen::Vector2d(ellipse.major_m, ellipse.minor_m),
                          -ellipse.angle_rad, with("outline", Colour::red));
      ellipses = true;
    }
    draw_direction(picture.svg, at, corner.orientation_rad, Colour::red);
    if (corner.is_convex)
      picture.svg.rect(at.array() - 4.0, at.array() + 4.0, with("marker", Colour::red));
    else
      picture.svg.circle(at, 4.5, with("marker", Colour::red));
  }
  const auto convex = static_cast<std::size_t>(std::ranges::count_if(layers.corners, &Corner::is_convex));
  picture.legend.push_back(
      {counted(layers.corners.size() - convex, "concave corner"), Mark::ring, Colour::red});
  picture.legend.push_back({counted(convex, "convex corner"), Mark::square, Colour::red});
  if (ellipses)
    picture.legend.push_back(
        {significant(sigma_count, 2) + " sigma of a corner", Mark::outline, Colour::red});
}

void draw_keypoints(Picture& picture, const WorldView& view, const KeypointLayer& layer) {
  for (const Keypoint& keypoint : layer.keypoints) {
    const Eigen::Vector2d at = view(keypoint.point);
    if (keypoint.scale_m > 0.0 && keypoint.scale_m <= kLargestScale_m)
      picture.svg.circle(at, keypoint.scale_m * view.px_per_m, with("outline", layer.colour));
    draw_direction(picture.svg, at, keypoint.orientation_rad, layer.colour);
    picture.svg.circle(at, 3.5, with("marker", layer.colour));
  }
  picture.legend.push_back({layer.name + ": " + counted(layer.keypoints.size(), "keypoint") +
                                ", with orientation and (up to 1 m) scale",
                            Mark::ring, layer.colour});
}

}  // namespace

Picture draw_scan(const Scan& scan, const ScanLayers& layers, const ScanViewConfig& config) {
  const WorldView view = world_view(bounds_of(scan, layers), config.width_px, config.max_height_px);
  const Eigen::Vector2d end = view.bottom_right_px();
  Picture picture{config.width_px, end.y() + kBelowWorld_px, {}, "a scan with what was found in it", {}, {}};
  draw_world_grid(picture.svg, view);
  picture.svg.open_window(view.top_left_px, end);
  draw_hits(picture, view, scan, layers);
  draw_lines(picture, view, layers);
  draw_circles(picture, view, layers);
  for (const KeypointLayer& layer : layers.keypoints) draw_keypoints(picture, view, layer);
  draw_corners(picture, view, layers, config.ellipse_sigma_count);
  draw_sensor(picture, view);
  picture.svg.close();
  picture.svg.rect(view.top_left_px, end, "axis");
  draw_scale_bar(picture.svg, view);
  return picture;
}

}  // namespace beaconless::report
