// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/beam_model.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

/// The borders between occupied cells and others along the rows (or, turned, the columns) of a grid.
void add_borders(const OccupancyGrid& grid, bool along_rows, std::vector<Segment2>& walls) {
  const int lines = (along_rows ? grid.height_cells : grid.width_cells) + 1;
  const int length = along_rows ? grid.width_cells : grid.height_cells;
  const auto is_border = [&](int line, int place) {
    const Cell one = along_rows ? Cell{place, line} : Cell{line, place};
    const Cell other = along_rows ? Cell{place, line - 1} : Cell{line - 1, place};
    return place < length && grid.is_occupied(one) != grid.is_occupied(other);
  };
  const auto corner = [&](int line, int place) {
    const Eigen::Vector2d cells(along_rows ? place : line, along_rows ? line : place);
    return Eigen::Vector2d(grid.map_from_grid * Eigen::Vector2d(grid.resolution_m * cells));
  };
  for (int line = 0; line < lines; ++line) {
    int begin = -1;
    for (int place = 0; place <= length; ++place) {
      const bool is_on = is_border(line, place);
      if (is_on && begin < 0) begin = place;
      if (is_on || begin < 0) continue;
      walls.push_back({corner(line, begin), corner(line, place)});
      begin = -1;
    }
  }
}

}  // namespace

std::vector<Segment2> ray_walls_of(const Map& map) {
  if (const auto* plan = std::get_if<FloorPlan>(&map)) return plan->segments();
  std::vector<Segment2> walls;
  add_borders(std::get<OccupancyGrid>(map), true, walls);
  add_borders(std::get<OccupancyGrid>(map), false, walls);
  return walls;
}

BeamModel::BeamModel(const Map& map, const AmclConfig& config) : config_(config), walls_(ray_walls_of(map)) {}

double BeamModel::log_likelihood(const CastBeam& beam, double expected_m) const {
  const double most_m = config_.laser_max_range;
  const double sigma_m = config_.laser_sigma_hit;
  const double lambda = config_.laser_lambda_short;
  const double way_m = std::min(expected_m, most_m);
  double p = 1e-9;
  if (beam.is_hit) {
    const double sigmas = (beam.range_m - way_m) / sigma_m;
    const double scale = 1.0 / (sigma_m * std::sqrt(2.0));
    const double within = 0.5 * (std::erf((most_m - way_m) * scale) + std::erf(way_m * scale));
    p += config_.laser_z_hit * std::exp(-0.5 * sigmas * sigmas) /
         (sigma_m * std::sqrt(2.0 * kPi) * std::max(within, 0.1));
    if (beam.range_m < way_m)
      p += config_.laser_z_short * lambda * std::exp(-lambda * beam.range_m) / -std::expm1(-lambda * way_m);
    p += config_.laser_z_rand / most_m;
  } else {
    // Nothing came back: by chance, or because there is nothing within range.
    p += config_.laser_z_max + (expected_m > beam.range_m ? config_.laser_z_hit : 0.0);
  }
  return std::log(p);
}

void BeamModel::sum(const Particles& particles, const Pose2& base_from_laser,
                    const std::vector<CastBeam>& beams, std::vector<double>& sums) const {
  sums.assign(particles.size(), 0.0);
  const double beyond_m = config_.laser_max_range + 1.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Pose2 map_from_laser = particles.pose(i) * base_from_laser;
    const Eigen::Matrix2d turn = map_from_laser.rotation();
    for (const CastBeam& beam : beams) {
      const auto hit =
          walls_.cast(map_from_laser.translation(), turn * beam.direction, config_.laser_max_range);
      sums[i] += log_likelihood(beam, hit ? hit->range_m : beyond_m);
    }
  }
}

}  // namespace beaconless
