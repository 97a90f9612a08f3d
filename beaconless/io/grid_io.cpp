// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/grid_io.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "beaconless/core/describe.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr Range kResolution_m{1e-4, 100.0};
constexpr Range kOrigin_m{-1e7, 1e7};
constexpr Range kYaw_rad{-6.2832, 6.2832};

std::string allowed(const Range& range) {
  return "allowed: " + yaml_number(range.low) + " … " + yaml_number(range.high);
}

Error wrong(const std::string& path, const YamlNode& value, const std::string& key,
            const std::string& remedy) {
  return {where_in(path, value), key + " is " + value.described(), remedy};
}

/// A number of the map, or the default where it has one.
Result<double> number_of(const std::string& path, const YamlNode& yaml, const std::string& key,
                         const Range& range, std::optional<double> otherwise) {
  const YamlNode* value = yaml.find(key);
  if (value == nullptr && otherwise) return *otherwise;
  if (value == nullptr)
    return Error{path, "there is no " + key, "add the line `" + key + ": …`; " + allowed(range)};
  const auto number = value->number();
  if (!number || *number < range.low || *number > range.high) return wrong(path, *value, key, allowed(range));
  return *number;
}

Result<Pose2> origin_of(const std::string& path, const YamlNode& yaml) {
  const std::string form = "origin is [x, y, yaw], metres and radians: the lower left corner of the picture";
  const YamlNode* origin = yaml.find("origin");
  if (origin == nullptr)
    return Error{path, "there is no origin", "add the line `origin: [0, 0, 0]`; " + form};
  if (origin->kind != YamlNode::Kind::list || origin->size() != 3)
    return wrong(path, *origin, "origin", form);
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Range& range = i < 2 ? kOrigin_m : kYaw_rad;
    const auto number = origin->items[i].number();
    if (!number || *number < range.low || *number > range.high)
      return wrong(path, origin->items[i],
                   std::string("origin ") + (i == 0   ? "x"
                                             : i == 1 ? "y"
                                                      : "yaw"),
                   allowed(range) + (i < 2 ? " (m)" : " (rad)"));
    numbers[i] = *number;
  }
  return Pose2{numbers[0], numbers[1], wrap_angle(numbers[2])};
}

Result<bool> negate_of(const std::string& path, const YamlNode& yaml) {
  const YamlNode* value = yaml.find("negate");
  if (value == nullptr) return false;
  if (value->text == "0" || value->text == "false") return false;
  if (value->text == "1" || value->text == "true") return true;
  return wrong(path, *value, "negate", "allowed: 0 | 1 | false | true");
}

Result<GridMode> mode_of(const std::string& path, const YamlNode& yaml) {
  const YamlNode* value = yaml.find("mode");
  if (value == nullptr || value->text == "trinary") return GridMode::trinary;
  if (value->text == "scale") return GridMode::scale;
  if (value->text == "raw") return GridMode::raw;
  return wrong(path, *value, "mode", "allowed: trinary | scale | raw");
}

Result<GridShades> shades_of(const std::string& path, const YamlNode& yaml) {
  const auto mode = mode_of(path, yaml);
  if (!mode) return mode.error();
  const auto negate = negate_of(path, yaml);
  if (!negate) return negate.error();
  const GridShades defaults;
  const auto occupied = number_of(path, yaml, "occupied_thresh", {0.0, 1.0}, defaults.occupied_thresh);
  if (!occupied) return occupied.error();
  const auto free = number_of(path, yaml, "free_thresh", {0.0, 1.0}, defaults.free_thresh);
  if (!free) return free.error();
  if (*free >= *occupied)
    return Error{
        path, "free_thresh " + yaml_number(*free) + " is not below occupied_thresh " + yaml_number(*occupied),
        "usual values: free_thresh 0.196, occupied_thresh 0.65"};
  return GridShades{*mode, *negate, *occupied, *free};
}

std::vector<std::int8_t> cells_of(const GrayImage& image, const GridShades& shades) {
  std::array<std::int8_t, 256> table{};
  for (std::size_t shade = 0; shade < table.size(); ++shade)
    table[shade] = occupancy_percent_of(static_cast<std::uint8_t>(shade), shades);
  const bool see_through = shades.mode == GridMode::scale && !image.opacity.empty();
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  std::vector<std::int8_t> cells(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = (height - 1 - y) * width + x;  // the picture's first row is the top
      cells[y * width + x] =
          see_through && image.opacity[pixel] < 255 ? OccupancyGrid::kUnknown : table[image.shades[pixel]];
    }
  }
  return cells;
}

int percent(double ratio) { return static_cast<int>(std::lround(100.0 * ratio)); }

}  // namespace

std::int8_t occupancy_percent_of(std::uint8_t shade, const GridShades& shades) {
  const int light = shades.negate ? 255 - shade : shade;
  if (shades.mode == GridMode::raw)
    return light <= 100 ? static_cast<std::int8_t>(light) : OccupancyGrid::kUnknown;
  const double p = (255 - light) / 255.0;
  if (p > shades.occupied_thresh) return OccupancyGrid::kOccupied;
  if (p < shades.free_thresh) return OccupancyGrid::kFree;
  if (shades.mode == GridMode::trinary) return OccupancyGrid::kUnknown;
  const double ratio = (p - shades.free_thresh) / (shades.occupied_thresh - shades.free_thresh);
  return static_cast<std::int8_t>(std::lround(99.0 * ratio));
}

Result<OccupancyGrid> grid_from_yaml(const std::string& path, const YamlNode& yaml) {
  const YamlNode* name = yaml.find("image");
  if (name == nullptr)
    return Error{path, "holds " + yaml.described() + " without image:", "is it a map_server YAML?"};
  if (name->kind != YamlNode::Kind::scalar || name->text.empty())
    return wrong(path, *name, "image", "name a PGM or PNG picture");
  const auto resolution = number_of(path, yaml, "resolution", kResolution_m, std::nullopt);
  if (!resolution) return resolution.error();
  const auto origin = origin_of(path, yaml);
  if (!origin) return origin.error();
  const auto shades = shades_of(path, yaml);
  if (!shades) return shades.error();

  const auto image_path = std::filesystem::path(path).parent_path() / name->text;
  const auto image = read_image(image_path.string());
  if (!image)
    return Error{where_in(path, *name), "image: " + image.error().where + ": " + image.error().what,
                 "a relative path counts from the folder of the YAML"};
  const bool scale = shades->mode == GridMode::scale;
  const int occupied_from = scale ? OccupancyGrid::kOccupied : std::max(1, percent(shades->occupied_thresh));
  const int free_to =
      scale ? OccupancyGrid::kFree : std::min(occupied_from - 1, percent(shades->free_thresh));
  return OccupancyGrid{.resolution_m = *resolution,
                       .map_from_grid = *origin,
                       .width_cells = image->width_px,
                       .height_cells = image->height_px,
                       .occupancy_percent = cells_of(*image, *shades),
                       .occupied_from_percent = static_cast<std::int8_t>(occupied_from),
                       .free_to_percent = static_cast<std::int8_t>(free_to)};
}

Result<OccupancyGrid> read_grid(const std::string& path) {
  const auto yaml = read_yaml(path);
  if (!yaml) return yaml.error();
  return grid_from_yaml(path, *yaml);
}

Result<Done> write_grid(const std::string& path, const OccupancyGrid& grid) {
  std::filesystem::path image_path(path);
  if (image_path.extension() != ".yaml" && image_path.extension() != ".yml")
    return Error{path, "a grid's name ends in .yaml",
                 "name it …/map.yaml; the picture goes beside it as …/map.pgm"};
  image_path.replace_extension(".pgm");
  const auto cells = static_cast<std::size_t>(grid.width_cells) * static_cast<std::size_t>(grid.height_cells);
  if (cells == 0 || cells != grid.occupancy_percent.size()) return Error{path, "the grid has no cells", ""};

  if (grid.free_to_percent >= grid.occupied_from_percent)
    return Error{path,
                 "free_to_percent " + std::to_string(grid.free_to_percent) +
                     " is not below occupied_from_percent " + std::to_string(grid.occupied_from_percent),
                 ""};

  // 0.4 below the percent, so that 20 is written as map_saver's 0.196 and reads back as 20; away from 0 and
  // 1, since map_server's comparisons are strict.
  const double occupied_thresh = std::min(0.996, grid.occupied_from_percent / 100.0);
  const double free_thresh = std::max(0.004, (grid.free_to_percent - 0.4) / 100.0);
  constexpr std::uint8_t kFreeShade = 254;
  constexpr std::uint8_t kUsualUnknownShade = 205;
  const GridShades shades{GridMode::trinary, false, occupied_thresh, free_thresh};
  const auto middle =
      static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - (occupied_thresh + free_thresh) / 2.0)));
  const bool usual = occupancy_percent_of(kUsualUnknownShade, shades) == OccupancyGrid::kUnknown;
  const std::uint8_t unknown_shade = usual ? kUsualUnknownShade : middle;

  GrayImage image{grid.width_cells, grid.height_cells, {}, {}};
  image.shades.reserve(cells);
  for (int y = grid.height_cells - 1; y >= 0; --y)
    for (int x = 0; x < grid.width_cells; ++x)
      image.shades.push_back(grid.is_occupied({x, y}) ? 0
                             : grid.is_free({x, y})   ? kFreeShade
                                                      : unknown_shade);
  auto written = write_pgm(image_path.string(), image);
  if (!written) return written;

  return write_whole_file(
      path, "image: " + yaml_text(image_path.filename().string()) +
                "\nmode: trinary\nresolution: " + yaml_number(grid.resolution_m) + "\norigin: [" +
                yaml_number(grid.map_from_grid.x_m) + ", " + yaml_number(grid.map_from_grid.y_m) + ", " +
                yaml_number(wrap_angle(grid.map_from_grid.theta_rad)) + "]\nnegate: 0\noccupied_thresh: " +
                yaml_number(occupied_thresh) + "\nfree_thresh: " + yaml_number(free_thresh) + "\n");
}

}  // namespace beaconless::io
