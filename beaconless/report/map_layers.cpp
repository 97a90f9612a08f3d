// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_layers.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>

#include "beaconless/report/grid_raster.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

std::string classes(std::string_view kind, Colour colour) {
  return std::string(kind) + " " + std::string(to_string(colour));
}

constexpr double kRasterDensity = 1.5;  // pixels of a grid map to a unit of the picture, for fine screens

/// A position on the grid of half pixels, for those that can be seen.
std::optional<std::int64_t> half_pixel(const WorldView& view, const Eigen::Vector2d& at) {
  const Eigen::Vector2d end = view.bottom_right_px();
  if (!at.allFinite() || (at.array() < view.top_left_px.array()).any() || (at.array() > end.array()).any())
    return std::nullopt;
  return static_cast<std::int64_t>(2.0 * at.x()) << 32 | static_cast<std::int64_t>(2.0 * at.y());
}

}  // namespace

void draw_building(Picture& picture, const WorldView& view, const FloorPlan& plan, const MapViewConfig&) {
  PathData walls;
  for (const auto& wall : plan.walls) {
    walls.lift();
    for (const Eigen::Vector2d& corner : wall) walls.line_to(view(corner));
    if (wall.size() > 2 && wall.front() == wall.back()) walls.close();
  }
  if (walls.empty()) return;
  picture.svg.path(walls, classes("line", Colour::ink));
  picture.legend.push_back({"wall", Mark::wall, Colour::ink});
}

void draw_building(Picture& picture, const WorldView& view, const OccupancyGrid& grid,
                   const MapViewConfig& config) {
  // Finer than the picture shows would only alias: thin walls would come and go.
  const Eigen::Vector2d seen = view.bottom_right_px() - view.top_left_px;
  const auto useful = static_cast<std::size_t>(kRasterDensity * kRasterDensity * seen.x() * seen.y());
  const GridRaster raster = raster_of(grid, std::min(config.max_pixels, useful));
  if (raster.image.pixels.empty()) return;
  // Pixel rows run down, the map's y runs up: the image's upper left corner is where its last row of cells
  // ends.
  const auto corner = [&](double x_pixels, double y_pixels) {
    return view(raster.map_from_image *
                Eigen::Vector2d(x_pixels * raster.pixel_m, y_pixels * raster.pixel_m));
  };
  const double rows = raster.image.height_px;
  Eigen::Matrix<double, 2, 3> picture_from_pixel;
  picture_from_pixel.col(2) = corner(0.0, rows);
  picture_from_pixel.col(0) = corner(1.0, rows) - corner(0.0, rows);
  picture_from_pixel.col(1) = corner(0.0, rows - 1.0) - corner(0.0, rows);
  picture.svg.png(encode_png(raster.image), {raster.image.width_px, raster.image.height_px},
                  picture_from_pixel, view.px_per_m * raster.pixel_m < 2.0 ? "raster" : "raster pixels");
  const auto& pixels = raster.image.pixels;
  picture.legend.push_back({"occupied", Mark::bar, Colour::ink});
  if (std::find(pixels.begin(), pixels.end(), 0) != pixels.end())
    picture.legend.push_back({"unknown", Mark::unknown, Colour::grey});
}

void draw_scans(Picture& picture, const WorldView& view, std::span<const PlacedScan> scans,
                const MapViewConfig& config) {
  std::size_t hits = 0;
  for (const PlacedScan& placed : scans) hits += placed.scan.hit_count();
  const std::size_t stride = 1 + hits / std::max<std::size_t>(config.max_scan_points, 1);
  std::unordered_set<std::int64_t> taken;
  PathData dots;
  std::size_t count = 0;
  for (const PlacedScan& placed : scans)
    for (std::size_t beam = 0; beam < placed.scan.size(); ++beam) {
      if (!placed.scan.is_hit(beam) || count++ % stride != 0) continue;
      const Eigen::Vector2d at = view(placed.map_from_laser * placed.scan.point(beam));
      if (const auto key = half_pixel(view, at); key && taken.insert(*key).second) dots.dot(at);
    }
  if (dots.empty()) return;
  picture.svg.path(dots, classes("dots", Colour::green));
  const std::string number_of = grouped(scans.size()) + (scans.size() == 1 ? " scan" : " scans");
  picture.legend.push_back({number_of + " laid over the map", Mark::dots, Colour::green});
}

}  // namespace beaconless::report
