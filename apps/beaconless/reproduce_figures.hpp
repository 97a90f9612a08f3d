// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "beaconless/report/picture.hpp"

#include "reproduce_experiments.hpp"

/// The figures of the report, each with a caption that says what the dissertation's showed.
namespace beaconless::cli {

/// One figure of the dissertation: a few pictures, each with what it shows.
struct Figure {
  std::string caption;  ///< "Figure 4.10. …"
  struct Part {
    std::string caption;
    report::Picture picture;
  };
  std::vector<Part> parts;  ///< wide ones below each other, others in rows of two
};

/// Figures 4.5 to 4.9. In: a scene of the full room, and the scenes to take frames for 4.9 from.
std::vector<Figure> scan_figures(const Scene& full_room, std::span<const Scene> scenes);

/// Figures 4.10 to 4.13: the position's error against the scan, by the dissertation's groups of methods.
std::vector<Figure> error_figures(std::span<const Experiment> experiments);

/// Figures 4.14 to 4.16: where the robot stood, and the paths of ICP over the map.
std::vector<Figure> path_figures(std::span<const Scene> scenes, std::span<const Experiment> experiments);

/// Figures 4.17 and 4.18: the paths of Hector, and what may mislead.
std::vector<Figure> hector_figures(std::span<const Scene> scenes, std::span<const Experiment> experiments);

const Scene& scene_named(std::span<const Scene> scenes, std::string_view name);

}  // namespace beaconless::cli
