// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/feature_map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "beaconless/report/covariance_ellipse.hpp"
#include "beaconless/report/map_bounds.hpp"
#include "beaconless/report/map_layers.hpp"
#include "beaconless/report/text.hpp"
#include "beaconless/report/world_frame.hpp"

namespace beaconless::report {
namespace {

constexpr double kArrow_px = 11.0;
constexpr double kMark_px = 3.0;
constexpr double kLeastEllipse_px = 5.0;

/// Features of one colour.
struct Class {
  double least_share;
  Colour colour;
  std::string_view words;
};

// In the order in which they are drawn: what is seldom found below the rest.
constexpr std::array kClasses{Class{0.0, Colour::orange, ", found by fewer"},
                              Class{0.25, Colour::green, ", found by a quarter"},
                              Class{0.5, Colour::blue, ", drawn or found by half of the views that see it"}};

Colour colour_of(const FeatureEvidence& evidence) {
  Colour colour = kClasses.front().colour;
  for (const Class& of : kClasses)
    if (evidence.share >= of.least_share) colour = of.colour;
  return colour;
}

std::string with(std::string_view classes, Colour colour) {
  return std::string(classes) + " " + std::string(to_string(colour));
}

void draw_feature(Svg& svg, const WorldView& view, const PointFeature& feature, Colour colour,
                  double sigma_count) {
  const Eigen::Vector2d at = view(feature.point);
  const Ellipse ellipse = covariance_ellipse(feature.covariance, sigma_count);
  if (ellipse.major_m * view.px_per_m >= kLeastEllipse_px)
    svg.ellipse(at, view.px_per_m * Eigen::Vector2d(ellipse.major_m, ellipse.minor_m), -ellipse.angle_rad,
                with("outline", colour));
  const Eigen::Vector2d along(std::cos(feature.orientation_rad), -std::sin(feature.orientation_rad));
  svg.line(at, at + kArrow_px * along, with("line", colour));
  svg.circle(at, kMark_px, with("marker", colour));
}

}  // namespace

Picture draw_feature_map(const Map& map, const FeatureMap& features, const MapViewConfig& config) {
  // 1. The building.
  const WorldView view = world_view(bounds_of_run(map, {}, {}), config.width_px, config.max_height_px);
  const Eigen::Vector2d end = view.bottom_right_px();
  Picture picture{config.width_px, end.y() + kBelowWorld_px, {}, "map with its features", {}, {}};
  draw_world_grid(picture.svg, view);
  picture.svg.open_window(view.top_left_px, end);
  std::visit([&](const auto& building) { draw_building(picture, view, building, config); }, map);
  // 2. Its features; the legend begins with the best.
  const auto building_entries = static_cast<std::ptrdiff_t>(picture.legend.size());
  for (const Class& of : kClasses) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < features.features.size(); ++i) {
      if (colour_of(features.evidence[i]) != of.colour) continue;
      draw_feature(picture.svg, view, features.features[i], of.colour, config.ellipse_sigma_count);
      ++count;
    }
    if (count == 0) continue;
    std::string words = grouped(count);
    words += count == 1 ? " feature" : " features";
    words += of.words;
    picture.legend.push_back({words, Mark::ring, of.colour});
  }
  std::reverse(picture.legend.begin() + building_entries, picture.legend.end());
  picture.svg.close();
  picture.svg.rect(view.top_left_px, end, "axis");
  draw_scale_bar(picture.svg, view);
  return picture;
}

}  // namespace beaconless::report
