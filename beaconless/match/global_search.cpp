// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/global_search.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/match/best_apart.hpp"
#include "beaconless/match/tile_sums.hpp"

namespace beaconless {
namespace {

constexpr double kApart_m = 0.5;
constexpr double kApart_rad = radians(10.0);

}  // namespace

void describe(Fields& fields, GlobalSearchConfig& config) {
  fields("cell_m", config.cell_m, {0.02, 1.0},
         "distance between places that are tried, and cells of the map that tell how near walls are");
  fields("step_deg", config.step_deg, {0.1, 10.0}, "angle between headings that are tried");
  fields("truncate_m", config.truncate_m, {0.05, 10.0},
         "points further from every wall than this all count the same");
  fields("points", config.points, {10, 125}, "points of the scan that vote, evenly taken");
  fields("keep", config.keep, {2, 1000}, "best places that are looked at closely …");
  fields("hopeless", config.hopeless, {0.0, 1.0},
         "… whose cost is at most so much above the best, as a share of the worst cost");
  fields("threads", config.threads, {1, 64},
         "that share the work of a search; what is found is the same with any number");
}

void search_everywhere(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                       const FloorPlan::Bounds& box, const GlobalSearchConfig& config,
                       GlobalSearchScratch& scratch, std::vector<StartPose>& places) {
  thin(points, config.points, scratch.points);
  const Eigen::Vector2d middle = 0.5 * (box.low + box.high);
  const Eigen::Vector2d half = (0.5 * (box.high - box.low)).cwiseMax(0.0) / map.cell_m();
  const PoseLattice lattice{.middle = {middle.x(), middle.y(), 0.0},
                            .moves_x = static_cast<int>(std::ceil(half.x())),
                            .moves_y = static_cast<int>(std::ceil(half.y())),
                            .turns = static_cast<int>(std::ceil(180.0 / config.step_deg)),
                            .step_rad = radians(config.step_deg)};
  const LatticeWish wish{.keep = config.keep,
                         .hopeless = config.hopeless,
                         .apart_m = kApart_m,
                         .apart_rad = kApart_rad,
                         .threads = config.threads};
  search_lattice(scratch.points, map, lattice, wish, scratch.lattice, places);
}

}  // namespace beaconless
