// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "beaconless/eval/association.hpp"

namespace beaconless::eval {

/// Below this root-mean-square distance of the reference positions from their middle, they tell no rotation.
inline constexpr double kLeastSpread_m = 0.1;

/// The rigid motion reference_from_estimate that brings the estimates nearest to their references.
///
/// Rotation and translation have the least squared distance of the positions (no scale). Of a robot that
/// stands or turns in place (see kLeastSpread_m) the positions tell no rotation; it is then the mean
/// difference of the headings, and the translation brings the middles together. The identity for no pairs.
/// Source: Umeyama, "Least-squares estimation of transformation parameters", TPAMI 1991, in the plane.
Pose2 align(std::span<const PosePair> pairs);

}  // namespace beaconless::eval
