// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/slam/hector_slam_config.hpp"

namespace beaconless::cli {

/// The parameters of `map build --slam` as --set and --config name them, by method.
struct SlamParameters {
  HectorSlamConfig hector_slam;
};

inline void describe(Fields& fields, SlamParameters& parameters) {
  fields.section("hector_slam", parameters.hector_slam);
}

}  // namespace beaconless::cli
