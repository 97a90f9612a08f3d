// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_view.hpp"

#include <algorithm>
#include <string>

#include "beaconless/report/map_bounds.hpp"
#include "beaconless/report/map_layers.hpp"
#include "beaconless/report/text.hpp"
#include "beaconless/report/world_frame.hpp"

namespace beaconless::report {
namespace {

/// How many poses with a place lie outside of what is seen.
std::size_t count_outside(const WorldView& view, std::span<const PoseEstimate> estimates) {
  const Eigen::AlignedBox2d seen(view.low_m, view.high_m);
  return static_cast<std::size_t>(
      std::count_if(estimates.begin(), estimates.end(), [&](const PoseEstimate& e) {
        return e.status != Status::not_started && !seen.contains(e.map_from_base.translation());
      }));
}

}  // namespace

Picture draw_map(const Map& map, std::span<const PoseEstimate> estimates, const Trajectory& reference,
                 std::span<const PlacedScan> scans, const MapViewConfig& config) {
  return draw_map(map, estimates, reference, scans, {}, config);
}

Picture draw_map(const Map& map, std::span<const PoseEstimate> estimates, const Trajectory& reference,
                 std::span<const PlacedScan> scans, std::span<const MapMarks> marks,
                 const MapViewConfig& config) {
  const WorldView view = world_view(config.window ? *config.window : bounds_of_run(map, estimates, reference),
                                    config.width_px, config.max_height_px);
  const Eigen::Vector2d end = view.bottom_right_px();
  Picture picture{config.width_px, end.y() + kBelowWorld_px, {}, "map with the path of the robot", {}, {}};
  draw_world_grid(picture.svg, view);
  picture.svg.open_window(view.top_left_px, end);
  std::visit([&](const auto& building) { draw_building(picture, view, building, config); }, map);
  draw_scans(picture, view, scans, config);
  draw_reference(picture, view, reference);
  draw_ellipses(picture, view, estimates, config);
  draw_estimates(picture, view, estimates);
  draw_ends(picture, view, estimates);
  for (const MapMarks& of : marks) draw_marks(picture, view, of);
  picture.svg.close();
  picture.svg.rect(view.top_left_px, end, "axis");
  draw_scale_bar(picture.svg, view);
  if (const std::size_t outside = count_outside(view, estimates); outside > 0)
    picture.note = grouped(outside) + " of " + grouped(estimates.size()) + " poses lie outside the picture.";
  return picture;
}

}  // namespace beaconless::report
