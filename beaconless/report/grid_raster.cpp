// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/grid_raster.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace beaconless::report {
namespace {

constexpr int kLevels = 15;  // of occupancy; with "unknown" they fill the 4 bits of a pixel

/// Corners of a part of the grid; `high` belongs to it.
struct CellBox {
  Cell low;
  Cell high;
};

std::optional<CellBox> known_box(const OccupancyGrid& grid) {
  std::optional<CellBox> box;
  for (Cell cell; cell.y < grid.height_cells; ++cell.y)
    for (cell.x = 0; cell.x < grid.width_cells; ++cell.x) {
      if (grid.occupancy_percent[grid.index(cell)] < 0) continue;
      if (!box) box = CellBox{cell, cell};
      box->low.x = std::min(box->low.x, cell.x);
      box->high.x = std::max(box->high.x, cell.x);
      box->high.y = cell.y;
    }
  return box;
}

/// What stands for a square of cells; kUnknown when all of them are, or lie outside.
int block_percent(const OccupancyGrid& grid, Cell low, int block) {
  int most = OccupancyGrid::kUnknown;
  int sum = 0;
  int known = 0;
  for (int y = low.y; y < low.y + block; ++y)
    for (int x = low.x; x < low.x + block; ++x) {
      const int percent = grid.at({x, y});
      if (percent < 0) continue;
      most = std::max(most, percent);
      sum += percent;
      ++known;
    }
  return known == 0 || most >= grid.occupied_from_percent ? most : sum / known;
}

std::uint8_t level_of(int percent) {
  if (percent < 0) return 0;
  return static_cast<std::uint8_t>(1 + (std::min(percent, 100) * (kLevels - 1) + 50) / 100);
}

std::vector<IndexedImage::Rgba> palette() {
  std::vector<IndexedImage::Rgba> colours{{128, 128, 128, 56}};
  for (int level = 0; level < kLevels; ++level)
    colours.push_back({0, 0, 0, static_cast<std::uint8_t>(level * 230 / (kLevels - 1))});
  return colours;
}

}  // namespace

GridRaster raster_of(const OccupancyGrid& grid, std::size_t max_pixels) {
  if (grid.width_cells <= 0 || grid.height_cells <= 0 || !(grid.resolution_m > 0.0) ||
      !grid.map_from_grid.is_finite())
    return {};
  if (grid.occupancy_percent.size() !=
      static_cast<std::size_t>(grid.width_cells) * static_cast<std::size_t>(grid.height_cells))
    return {};
  const auto box = known_box(grid);
  if (!box) return {};
  const int width = box->high.x - box->low.x + 1;
  const int height = box->high.y - box->low.y + 1;
  const double excess =
      static_cast<double>(width) * height / static_cast<double>(std::max<std::size_t>(max_pixels, 1));
  const int block = std::max(1, static_cast<int>(std::ceil(std::sqrt(excess))));

  GridRaster raster;
  raster.pixel_m = block * grid.resolution_m;
  raster.map_from_image =
      grid.map_from_grid * Pose2{box->low.x * grid.resolution_m, box->low.y * grid.resolution_m, 0.0};
  IndexedImage& image = raster.image;
  image.width_px = (width + block - 1) / block;
  image.height_px = (height + block - 1) / block;
  image.palette = palette();
  image.pixels.assign(static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px),
                      0);
  std::size_t i = 0;
  for (int row = image.height_px - 1; row >= 0; --row)
    for (int column = 0; column < image.width_px; ++column) {
      const Cell low{box->low.x + column * block, box->low.y + row * block};
      image.pixels[i++] = level_of(block_percent(grid, low, block));
    }
  return raster;
}

}  // namespace beaconless::report
