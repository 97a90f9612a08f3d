// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/path.hpp"

namespace beaconless::sim {
namespace {

constexpr Range kPlace_m{-1e6, 1e6};
constexpr Range kSemiAxis_m{0.01, 1e4};
constexpr Range kHeading_deg{-360, 360};
constexpr Range kAngle_deg{-36000, 36000};
constexpr Range kSpeed_mps{0.001, 100};
constexpr Range kRate_degps{0.01, 3600};

}  // namespace

void describe(Fields& fields, Standing& path) {
  fields("x_m", path.x_m, kPlace_m, "where the base stands in the map");
  fields("y_m", path.y_m, kPlace_m, "where the base stands in the map");
  fields("heading_deg", path.heading_deg, kHeading_deg, "where the base looks, counter-clockwise from x");
}

void describe(Fields& fields, Turning& path) {
  fields("x_m", path.x_m, kPlace_m, "where the base turns in the map");
  fields("y_m", path.y_m, kPlace_m, "where the base turns in the map");
  fields("heading_deg", path.heading_deg, kHeading_deg,
         "where the base looks at first, counter-clockwise from x");
  fields("angle_deg", path.angle_deg, kAngle_deg, "how far it turns, counter-clockwise");
  fields("rate_degps", path.rate_degps, kRate_degps, "how fast it turns");
}

void describe(Fields& fields, Ellipse& path) {
  fields("center_x_m", path.center_x_m, kPlace_m, "middle of the ellipse in the map");
  fields("center_y_m", path.center_y_m, kPlace_m, "middle of the ellipse in the map");
  fields("semi_axis_x_m", path.semi_axis_x_m, kSemiAxis_m,
         "from the middle to the ellipse along its own x axis");
  fields("semi_axis_y_m", path.semi_axis_y_m, kSemiAxis_m,
         "from the middle to the ellipse along its own y axis");
  fields("heading_deg", path.heading_deg, kHeading_deg,
         "of the ellipse's own x axis, counter-clockwise from x");
  fields("start_deg", path.start_deg, kHeading_deg, "eccentric anomaly at the beginning");
  fields("turns", path.turns, {-1000, 1000}, "how often it goes around, counter-clockwise");
  fields("speed_mps", path.speed_mps, kSpeed_mps, "how fast the base drives");
}

void describe(Fields& fields, Waypoints& path) {
  fields("speed_mps", path.speed_mps, kSpeed_mps, "how fast the base drives");
  fields("rate_degps", path.rate_degps, kRate_degps, "how fast it turns");
}

}  // namespace beaconless::sim
