// SPDX-License-Identifier: Apache-2.0
// Figures 4.14 to 4.16: where the robot stood, and the paths of ICP over the map.
#include <fmt/format.h>

#include "beaconless/report/map_view.hpp"
#include "beaconless/report/plot.hpp"

#include "reproduce_figures_paths.hpp"
#include "reproduce_tables.hpp"

namespace beaconless::cli {
namespace {

using report::Colour;
using report::Mark;

/// The same for a method in every plot.
Colour colour_of(std::string_view method) {
  if (method.ends_with("-full")) return Colour::blue;
  if (method == "icp-corners" || method == "hector-keypoints") return Colour::orange;
  if (method == "icp-corners-ft" || method == "hector-regions") return Colour::green;
  return Colour::purple;
}

/// The robot where it truly stands, with its first scan.
Figure::Part position_part(const Scene& scene, std::string_view words) {
  const Pose2& base = scene.run.truth.front().pose;
  const Pose2 laser = base * scene.scenario.base_from_laser;
  const report::PlacedScan scan{scene.scan(0), laser};
  const std::array marks{
      report::MapMarks{"base of the robot", {base.translation()}, Colour::purple, Mark::square},
      report::MapMarks{"its laser, 0.7 m ahead", {laser.translation()}, Colour::purple, Mark::ring}};
  return {fmt::format("{}: base at x {:.2f} m, y {:.2f} m, heading {:.0f}°.", words, base.x_m, base.y_m,
                      degrees(base.theta_rad)),
          report::draw_map(scene.map(MapKind::exact), {}, {}, std::span(&scan, 1), marks, kHalfMap)};
}

Figure figure_414(std::span<const Scene> scenes) {
  return {
      "Figure 4.14. The two positions of the standing tests in the full room (the dissertation prints the "
      "caption of Figure 4.15 here): at the first the laser is close to an object, at the second much of the "
      "room is in view.",
      {position_part(scene_named(scenes, "room-position-1"), "Position 1"),
       position_part(scene_named(scenes, "room-position-2"), "Position 2")}};
}

Figure figure_415(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  const Scene& scene = scene_named(scenes, "room-ellipse");
  return {
      "Figure 4.15. The ellipse without obstacles, on the tape-measured plan. The dissertation's path from "
      "corners is noisy, most of all in the upper right corner of the room, but closed; that from the full "
      "scan has less error.",
      {path_part(scene, experiments, MapKind::tape, "icp-corners", "Extracted corners"),
       path_part(scene, experiments, MapKind::tape, "icp-full", "Full laser scan"),
       error_part(experiments, "room-ellipse", MapKind::tape,
                  std::array<std::string_view, 3>{"icp-corners", "icp-corners-ft", "icp-full"})}};
}

Figure figure_416(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  const std::array<std::string_view, 3> shown{"icp-full", "icp-corners-ft", "icp-falko"};
  return {
      "Figure 4.16. The same with people, on the tape-measured plan. The dissertation's full-scan path has "
      "many position errors as soon as somebody crosses, and its corner methods were not shown for their "
      "high errors.",
      {path_part(scene_named(scenes, "room-ellipse-people"), experiments, MapKind::tape, "icp-full",
                 "Full laser scan, one person"),
       path_part(scene_named(scenes, "room-ellipse-three-people"), experiments, MapKind::tape, "icp-full",
                 "Full laser scan, three people"),
       error_part(experiments, "room-ellipse-people", MapKind::tape, shown),
       error_part(experiments, "room-ellipse-three-people", MapKind::tape, shown)}};
}

}  // namespace

const Scene& scene_named(std::span<const Scene> scenes, std::string_view name) {
  for (const Scene& scene : scenes)
    if (scene.name() == name) return scene;
  return scenes.front();
}

Figure::Part path_part(const Scene& scene, std::span<const Experiment> experiments, MapKind map,
                       std::string_view method, std::string_view title) {
  const Experiment* experiment = find(experiments, scene.name(), map, method);
  if (experiment == nullptr)
    return {fmt::format("{}: {} is left out of this run.", title, method),
            report::draw_map(scene.map(map), {}, scene.run.truth, {}, kHalfMap)};
  return {
      fmt::format(
          "{} ({}): RMSE {} mm, largest error {} mm, start and end {} mm apart; {} ok, {} degraded, {} lost.",
          title, method, cell_mm(experiment->table.position_m.rmse),
          cell_mm(experiment->table.position_m.max), cell_mm(experiment->closure_m), experiment->ok_count,
          experiment->degraded_count, experiment->lost_count),
      report::draw_map(scene.map(map), experiment->estimates, scene.run.truth, {}, kHalfMap)};
}

Figure::Part error_part(std::span<const Experiment> experiments, std::string_view scenario, MapKind map,
                        std::span<const std::string_view> methods) {
  report::Plot plot{.x_title = "scan", .y_title = "position error [mm]", .log_y = true, .y_low = 0.5};
  for (const std::string_view method : methods) {
    const Experiment* experiment = find(experiments, scenario, map, method);
    if (experiment == nullptr) continue;
    report::Series series{.name = std::string(method), .colour = colour_of(method), .mark = Mark::thin};
    for (std::size_t i = 0; i < experiment->errors.size(); ++i) {
      series.x.push_back(static_cast<double>(i));
      series.y.push_back(1e3 * experiment->errors[i].position_m());
    }
    plot.series.push_back(std::move(series));
  }
  return {fmt::format("The error along the path: {}, {}.", scenario, words(map)),
          report::draw_plot(plot, {.width_px = 1000.0, .height_px = 300.0})};
}

std::vector<Figure> path_figures(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  return {figure_414(scenes), figure_415(scenes, experiments), figure_416(scenes, experiments)};
}

}  // namespace beaconless::cli
