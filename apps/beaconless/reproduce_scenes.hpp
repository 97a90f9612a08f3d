// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/map/map.hpp"
#include "beaconless/sim/scenario.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// What a room is known by when a robot is localized in it.
enum class MapKind : int {
  exact,  ///< the very plan that the scans were simulated in
  tape,   ///< the same as somebody with a tape would have measured it
  grid,   ///< the exact plan drawn into cells of 5 cm
};

inline constexpr std::array kMapKinds{MapKind::exact, MapKind::tape, MapKind::grid};

/// "exact plan", "tape-measured plan", "5 cm grid".
std::string_view words(MapKind kind);
/// "exact", "tape", "grid", for files.
std::string_view name_of(MapKind kind);

/// Where in its cell the origin of the map lies when the plan is drawn into cells. Nearly all walls of the
/// rooms lie at multiples of 5 cm: 0.5 would draw them exactly and 0 half a cell off. With a quarter they are
/// a quarter of a cell off, as walls anywhere are on average.
inline constexpr double kGridPhase_cells = 0.25;

/// A scenario with its scans and the maps to localize on.
struct Scene {
  sim::Scenario scenario;
  sim::SimulatedRun run;
  std::array<Map, kMapKinds.size()> maps;

  const Map& map(MapKind kind) const { return maps[static_cast<std::size_t>(kind)]; }
  const Scan& scan(std::size_t i) const { return std::get<Scan>(run.events[i]); }
  const std::string& name() const { return scenario.name; }
};

/// The scenarios of chapter 4, and one with more people, in the dissertation's order.
std::span<const std::string_view> reproduced_scenarios();

/// Simulates all of them; with `is_quick` only the first half second of each. Errors: the scenarios' files
/// are not found or cannot be run.
Result<std::vector<Scene>> simulate_scenes(const Console& console, int tape_seed, bool is_quick);

/// The places of scenes that share a plan, and so their maps; in order of the first of each.
std::vector<std::vector<std::size_t>> by_plan(std::span<const Scene> scenes);

}  // namespace beaconless::cli
