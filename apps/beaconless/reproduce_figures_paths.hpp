// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "beaconless/report/map_view.hpp"

#include "reproduce_figures.hpp"

/// Parts that figures of paths are made of.
namespace beaconless::cli {

inline const report::MapViewConfig kHalfMap{.width_px = 560.0, .max_height_px = 620.0};

/// The path of a method over the map, the truth below it as a pale line.
Figure::Part path_part(const Scene& scene, std::span<const Experiment> experiments, MapKind map,
                       std::string_view method, std::string_view title);

/// The errors of some methods along a drive, over the full width.
Figure::Part error_part(std::span<const Experiment> experiments, std::string_view scenario, MapKind map,
                        std::span<const std::string_view> methods);

}  // namespace beaconless::cli
