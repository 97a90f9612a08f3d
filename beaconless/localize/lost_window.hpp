// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/match/local_search.hpp"

namespace beaconless {

inline constexpr double kLostWindow = 2.5;  // how much wider a lost robot searches

/// The window of a local search, for a robot that is lost: wider, and at any heading.
inline LocalSearchConfig lost_window(LocalSearchConfig window) {
  window.window_m *= kLostWindow;
  window.window_deg = 180.0;
  return window;
}

}  // namespace beaconless
