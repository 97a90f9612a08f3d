// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer.hpp"

namespace beaconless::cli {

/// The robot stands about here.
struct StartHere {
  Pose2 map_from_base;
};

/// It stands anywhere on the map, or anywhere within a disc.
struct StartAnywhere {
  std::optional<SearchRegion> within;
};

/// It stands where it stood when the file was written; where it does not, anywhere.
struct StartResumed {
  std::string pose_file;
};

/// What is known of the place where a robot is switched on.
using Start = std::variant<StartHere, StartAnywhere, StartResumed>;

/// Reads the words of `--start`: "x,y,deg", "auto", "near:x,y,radius", "resume:FILE".
///
/// Errors: anything else, with the form that was probably meant.
Result<Start> start_from_words(std::string_view text);

}  // namespace beaconless::cli
