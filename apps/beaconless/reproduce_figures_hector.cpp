// SPDX-License-Identifier: Apache-2.0
// Figures 4.17 and 4.18: the paths of Hector, and what may mislead.
#include <fmt/format.h>

#include "reproduce_figures_paths.hpp"
#include "reproduce_misleading.hpp"
#include "reproduce_tables.hpp"

namespace beaconless::cli {
namespace {

using report::Colour;
using report::Mark;

constexpr std::array<std::string_view, 3> kHectors{"hector-full", "hector-keypoints", "hector-regions"};

Figure figure_417(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  Figure figure{
      "Figure 4.17. The ellipse by the three approaches with Hector, on the tape-measured plan, without and "
      "with a person. In the dissertation all are \"quite good\": keypoints alone have some trouble, most of "
      "all in the lower left corner of the room, which regions of interest mend.",
      {}};
  constexpr std::array<std::string_view, 3> kTitles{"Full laser scan", "Keypoints", "Regions of interest"};
  for (std::size_t m = 0; m < kHectors.size(); ++m)
    for (const std::string_view name : {"room-ellipse", "room-ellipse-people"})
      figure.parts.push_back(
          path_part(scene_named(scenes, name), experiments, MapKind::tape, kHectors[m],
                    fmt::format("{}, {}", kTitles[m], name == "room-ellipse" ? "normal" : "dynamic")));
  for (const std::string_view name : {"room-ellipse", "room-ellipse-people"})
    figure.parts.push_back(error_part(experiments, name, MapKind::tape, kHectors));
  return figure;
}

/// What each method made of one scan: "icp-full 3.1 mm, …".
std::string errors_in(std::span<const Experiment> experiments, std::string_view scenario, std::size_t scan) {
  std::string text;
  for (const Experiment& e : experiments) {
    if (e.scenario != scenario || e.map != MapKind::tape || e.errors.size() <= scan) continue;
    text +=
        fmt::format("{}{} {} mm{}", text.empty() ? "" : ", ", e.method, cell_mm(e.errors[scan].position_m()),
                    e.estimates[scan].ok() ? "" : fmt::format(" ({})", to_string(e.estimates[scan].status)));
  }
  return text;
}

report::PlacedScan placed(const Scene& scene, std::size_t scan) {
  return {scene.scan(scan), scene.run.truth[scan].pose * scene.scenario.base_from_laser};
}

/// The whole room, and the place where the map is worst, so near that centimetres are seen.
std::vector<Figure::Part> disagreement_parts(const Scene& scene, std::span<const Experiment> experiments) {
  const auto worst = worst_disagreement(scene, std::get<FloorPlan>(scene.map(MapKind::tape)));
  const report::PlacedScan scan = placed(scene, worst.scan);
  const std::array marks{
      report::MapMarks{"hits more than 3 cm from every wall", worst.far_hits, Colour::red, Mark::dots},
      report::MapMarks{"laser", {scan.map_from_laser.translation()}, Colour::purple, Mark::ring}};
  report::MapViewConfig near = kHalfMap;
  const Eigen::Vector2d half_m(0.7, 0.7);
  near.window = Eigen::AlignedBox2d(worst.worst_place() - half_m, worst.worst_place() + half_m);
  const auto draw = [&](const report::MapViewConfig& view) {
    return report::draw_map(scene.map(MapKind::tape), {}, {}, std::span(&scan, 1), marks, view);
  };
  return {{fmt::format("(a) The map is wrong: scan {} of {}, that whose hits lie furthest from the "
                       "tape-measured walls on average, {} mm with 10 mm of range noise. Errors: {}.",
                       worst.scan, scene.name(), cell_mm(worst.mean_m),
                       errors_in(experiments, scene.name(), worst.scan)),
           draw(kHalfMap)},
          {"(a) from near, where most of the hits lie that are far from every wall.", draw(near)}};
}

Figure::Part hidden_part(const Scene& scene, std::span<const Experiment> experiments,
                         std::string_view title) {
  const auto most = most_hidden_corners(scene);
  const report::PlacedScan scan = placed(scene, most.scan);
  const std::array marks{
      report::MapMarks{"person", most.people, Colour::orange, Mark::outline, 0.2},
      report::MapMarks{"corner that is hidden", most.hidden, Colour::red, Mark::square},
      report::MapMarks{"corner in view", most.seen, Colour::blue, Mark::square},
      report::MapMarks{"laser", {scan.map_from_laser.translation()}, Colour::purple, Mark::ring}};
  return {fmt::format("(b) {}: scan {} of {}, that in which the largest share of the corners of the room is "
                      "hidden, {} of {}. Errors: {}.",
                      title, most.scan, scene.name(), most.hidden.size(),
                      most.hidden.size() + most.seen.size(), errors_in(experiments, scene.name(), most.scan)),
          report::draw_map(scene.map(MapKind::tape), {}, {}, std::span(&scan, 1), marks, kHalfMap)};
}

Figure figure_418(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  Figure figure{
      "Figure 4.18. Two scans that may mislead, found by the criteria below. The dissertation shows one from "
      "the lower left corner that \"does not match with precision the real map\", and one in which an "
      "obstacle \"occludes some of the main features\".",
      disagreement_parts(scene_named(scenes, "room-ellipse"), experiments)};
  figure.parts.push_back(hidden_part(scene_named(scenes, "room-ellipse-people"), experiments,
                                     "Somebody stands before what matters"));
  figure.parts.push_back(
      hidden_part(scene_named(scenes, "room-ellipse-three-people"), experiments, "The same among three"));
  return figure;
}

}  // namespace

std::vector<Figure> hector_figures(std::span<const Scene> scenes, std::span<const Experiment> experiments) {
  return {figure_417(scenes, experiments), figure_418(scenes, experiments)};
}

}  // namespace beaconless::cli
