// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/local_search.hpp"

#include <cmath>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/match/best_apart.hpp"

namespace beaconless {
namespace {

constexpr double kHopeless = 0.2;  // a start whose cost is so much above the best is not worth following
constexpr double kApart_m =
    0.2;  // starts nearer than this, and turned by less than the next, lead to one pose
constexpr double kApart_rad = radians(5.0);

}  // namespace

void describe(Fields& fields, LocalSearchConfig& config) {
  fields("window_m", config.window_m, {0.0, 10.0}, "how far to each side starts are tried");
  fields("window_deg", config.window_deg, {0.0, 180.0}, "how far to each side headings are tried");
  fields("cell_m", config.cell_m, {0.005, 1.0},
         "distance between starts, and cells of the map that tell how near walls are");
  fields("step_deg", config.step_deg, {0.1, 30.0}, "angle between headings");
  fields("points", config.points, {10, 125}, "points of the scan that vote, evenly taken");
  fields("truncate_m", config.truncate_m, {0.01, 10.0},
         "points further from every wall than this all count the same");
  fields("far_penalty", config.far_penalty, {0.0, 10.0}, "cost of a start at the window's edge");
  fields("lost_stride", config.lost_stride, {1, 1000},
         "a lost robot searches, further around, with every so many scans");
  fields("keep", config.keep, {1, 100}, "best starts that are followed up");
}

void search_around(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map, const Pose2& guess,
                   const LocalSearchConfig& config, LocalSearchScratch& scratch,
                   std::vector<StartPose>& starts) {
  thin(points, config.points, scratch.points);
  const int moves = static_cast<int>(std::ceil(config.window_m / map.cell_m()));
  const PoseLattice lattice{.middle = guess,
                            .moves_x = moves,
                            .moves_y = moves,
                            .turns = static_cast<int>(std::ceil(config.window_deg / config.step_deg)),
                            .step_rad = radians(config.step_deg),
                            .far_penalty = config.far_penalty};
  const LatticeWish wish{
      .keep = config.keep, .hopeless = kHopeless, .apart_m = kApart_m, .apart_rad = kApart_rad};
  search_lattice(scratch.points, map, lattice, wish, scratch.lattice, starts);
}

}  // namespace beaconless
