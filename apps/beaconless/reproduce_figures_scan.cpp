// SPDX-License-Identifier: Apache-2.0
// Figures 4.5 to 4.9: what is found in single scans.
#include <fmt/format.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"

#include "features_pictures.hpp"
#include "reproduce_figures.hpp"

namespace beaconless::cli {
namespace {

constexpr report::ScanViewConfig kHalf{.width_px = 560.0, .max_height_px = 620.0};

std::vector<ScanSegment> segments(const Scan& scan, double threshold_m) {
  return segment_by_distance(scan, {.threshold = DistanceThreshold::constant, .constant_m = threshold_m});
}

std::size_t piece_count(const Scan& scan, double epsilon_m) {
  return split(scan, segments(scan, 0.1), {.epsilon_m = epsilon_m}).size();
}

Figure figure_45(const Scan& scan) {
  return {fmt::format("Figure 4.5. Number of segments by the distance threshold. The dissertation's falls "
                      "from 1081 at D_thd = 0.01 m (every beam its own) to 1 at 0.5 m, in its own room; here "
                      "{} at 0.01 m, {} at 0.05, {} at 0.10, {} at 0.20 and {} at 0.50: how soon it falls "
                      "depends on how far the walls are and how obliquely they are met.",
                      segments(scan, 0.01).size(), segments(scan, 0.05).size(), segments(scan, 0.10).size(),
                      segments(scan, 0.20).size(), segments(scan, 0.50).size()),
          {{"", segments_by_threshold(scan)}}};
}

Figure figure_46(const Scan& scan) {
  Figure figure{
      "Figure 4.6. The scan in segments, neighbours in different colours. The dissertation found them not "
      "yet fit for lines: segments remain that can still be split.",
      {}};
  for (const double threshold : {0.05, 0.10, 0.20, 0.50})
    figure.parts.push_back(
        {fmt::format("D_thd = {:.2f} m", threshold), segments_picture(scan, threshold, kHalf)});
  return figure;
}

Figure figure_47(const Scan& scan) {
  Figure figure{fmt::format("Figure 4.7. The same after Douglas-Peucker, from the {} segments of D_thd = "
                            "0.10 m. In the dissertation a low epsilon makes more segments and a high one "
                            "leaves some whole that could be important.",
                            segments(scan, 0.10).size()),
                {}};
  for (const double epsilon : {0.05, 0.10, 0.15, 0.30})
    figure.parts.push_back(
        {fmt::format("epsilon = {:.2f} m", epsilon), pieces_picture(scan, epsilon, kHalf)});
  return figure;
}

Figure figure_48(const Scan& scan) {
  return {
      fmt::format(
          "Figure 4.8. Number of segments by epsilon. The dissertation calls it \"far more consistent\" than "
          "Figure 4.5 and takes 0.15 to 0.20 m; here {} at 0.05 m, {} at 0.10, {} at 0.15 and {} at 0.20.",
          piece_count(scan, 0.05), piece_count(scan, 0.10), piece_count(scan, 0.15), piece_count(scan, 0.20)),
      {{"", pieces_by_epsilon(scan)}}};
}

/// Four frames by chance, as the dissertation took them; the same every time.
Figure figure_49(std::span<const Scene> scenes) {
  Figure figure{
      "Figure 4.9. Corners by least-squares lines and their intersections, in frames taken by chance, with "
      "the dissertation's parameters (epsilon 0.15 m, lines at least 45° apart, ends within 0.1 m of the "
      "crossing). It called its results \"quite promising\", with points missing that could have made more "
      "corners.",
      {}};
  Rng rng(49);
  for (const char* name : {"room-position-1", "room-position-2", "room-ellipse", "room-ellipse"}) {
    const Scene& scene = scene_named(scenes, name);
    const auto frame = static_cast<std::size_t>(rng.uniform() * static_cast<double>(scene.run.events.size()));
    figure.parts.push_back(
        {fmt::format("{}, scan {}", name, frame), dissertation_corners_picture(scene.scan(frame), kHalf)});
  }
  return figure;
}

}  // namespace

std::vector<Figure> scan_figures(const Scene& full_room, std::span<const Scene> scenes) {
  const Scan& scan = full_room.scan(0);
  return {figure_45(scan), figure_46(scan), figure_47(scan), figure_48(scan), figure_49(scenes)};
}

}  // namespace beaconless::cli
