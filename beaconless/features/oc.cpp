// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/oc.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "beaconless/features/dominant_direction.hpp"
#include "beaconless/features/four_floats.hpp"
#include "beaconless/features/local_maxima.hpp"
#include "beaconless/features/triangle_test.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// A right angle with one arm a third of the other's length is about this high.
constexpr float kFlattest = 0.25F;

/// How many neighbours lie along each half axis from the centre, and how many lie elsewhere.
struct Arms {
  float left = 0.0F;
  float right = 0.0F;
  float up = 0.0F;
  float down = 0.0F;
  float elsewhere = 0.0F;
  float x_of_vertical = 0.0F;  ///< sums, as seen from the centre
  float y_of_horizontal = 0.0F;

  float horizontal() const { return std::max(left, right); }
  float vertical() const { return std::max(up, down); }
  float against() const { return elsewhere + std::min(left, right) + std::min(up, down); }
};

/// Counts four neighbours at a time, without branches. Those nearer than the tolerance say nothing.
Arms arms_of(const OcScratch& scratch, std::size_t centre, float tolerance_m) {
  const BeamNeighbourhoods& around = scratch.around;
  const float radius_squared = around.radius_m[centre] * around.radius_m[centre];
  const Floats4 one = Floats4{} + 1.0F;
  Floats4 left{};
  Floats4 right{};
  Floats4 up{};
  Floats4 down{};
  Floats4 elsewhere{};
  Floats4 x_of_vertical{};
  Floats4 y_of_horizontal{};
  for (std::size_t place = around.first[centre]; place <= around.last[centre]; place += 4) {
    const Floats4 dx = load4(scratch.x_m.data() + place) - scratch.x_m[centre];
    const Floats4 dy = load4(scratch.y_m.data() + place) - scratch.y_m[centre];
    const Ints4 left_over = Ints4{0, 1, 2, 3} <= static_cast<std::int32_t>(around.last[centre] - place);
    const Ints4 in = (dx * dx + dy * dy <= radius_squared) & left_over;
    const Ints4 near_x = in & (abs4(dx) < tolerance_m);
    const Ints4 near_y = in & (abs4(dy) < tolerance_m);
    const Ints4 vertical = near_x & ~near_y;
    const Ints4 horizontal = near_y & ~near_x;
    left += where(horizontal & (dx < 0.0F), one);
    right += where(horizontal & (dx > 0.0F), one);
    down += where(vertical & (dy < 0.0F), one);
    up += where(vertical & (dy > 0.0F), one);
    elsewhere += where(in & ~near_x & ~near_y, one);
    x_of_vertical += where(vertical, dx);
    y_of_horizontal += where(horizontal, dy);
  }
  return {sum(left),          sum(right),          sum(up), sum(down), sum(elsewhere),
          sum(x_of_vertical), sum(y_of_horizontal)};
}

double score_of(OcScore kind, const Arms& arms) {
  if (kind == OcScore::balance) {
    const float vertical = arms.up + arms.down;
    const float horizontal = arms.left + arms.right;
    return static_cast<double>((vertical + horizontal) / (0.1F + std::abs(vertical - horizontal)));
  }
  const float on = arms.vertical() + arms.horizontal();
  return static_cast<double>(on / (on + arms.against()));
}

/// Turns the points so that walls run along the axes.
void turn(const UnrolledScan& points, double direction_rad, std::vector<float>& x_m,
          std::vector<float>& y_m) {
  const auto cosine = static_cast<float>(std::cos(direction_rad));
  const auto sine = static_cast<float>(std::sin(direction_rad));
  x_m.resize(points.size());
  y_m.resize(points.size());
  for (std::size_t place = 0; place < points.size(); ++place) {
    x_m[place] = cosine * points.x_m[place] + sine * points.y_m[place];
    y_m[place] = cosine * points.y_m[place] - sine * points.x_m[place];
  }
}

/// The corner that the arms make, in the sensor frame.
Keypoint corner_of(const OcScratch& scratch, std::size_t centre, const Arms& arms) {
  const Eigen::Vector2f turned(scratch.x_m[centre] + arms.x_of_vertical / (arms.up + arms.down),
                               scratch.y_m[centre] + arms.y_of_horizontal / (arms.left + arms.right));
  const Eigen::Rotation2Dd back(scratch.direction_rad);
  const double quarter = arms.up >= arms.down ? (arms.right >= arms.left ? 0.25 : 0.75)
                                              : (arms.right >= arms.left ? -0.25 : -0.75);
  return {.beam = centre - scratch.around.points.begin(),
          .point = back * turned.cast<double>(),
          .orientation_rad = wrap_angle(scratch.direction_rad + quarter * kPi),
          .scale_m = static_cast<double>(scratch.around.radius_m[centre])};
}

}  // namespace

void detect_oc(const Scan& scan, const OcConfig& config, OcScratch& scratch,
               std::vector<Keypoint>& keypoints) {
  BeamNeighbourhoods& around = scratch.around;
  // 1. which way the walls run
  around.assign(scan, config.radius);
  scratch.direction_rad = dominant_direction(around);
  turn(around.points, scratch.direction_rad, scratch.x_m, scratch.y_m);
  // 2. the arms of every neighbourhood that is a triangle
  keypoints.clear();
  const auto tolerance = static_cast<float>(config.tolerance_m);
  const auto min_points = static_cast<float>(config.min_points);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = static_cast<double>(scan.ranges_m()[beam]);
    if (!scan.is_hit(beam) || range < config.range_min_m || range > config.range_max_m) continue;
    const std::size_t centre = around.points.begin() + beam;
    if (!is_triangle(around, centre, kFlattest)) continue;
    const Arms arms = arms_of(scratch, centre, tolerance);
    if (arms.horizontal() < min_points || arms.vertical() < min_points) continue;
    const double score = score_of(config.score, arms);
    if (score < config.min_score) continue;
    keypoints.push_back(corner_of(scratch, centre, arms));
    keypoints.back().score = score;
  }
  // 3. the best of each place
  keep_local_maxima(scan, config.nms_radius_m, keypoints, scratch.candidates);
}

std::vector<Keypoint> detect_oc(const Scan& scan, const OcConfig& config) {
  OcScratch scratch;
  std::vector<Keypoint> keypoints;
  detect_oc(scan, config, scratch, keypoints);
  return keypoints;
}

void describe(Fields& fields, OcConfig& config) {
  fields("range_min_m", config.range_min_m, {0.0, 1000.0}, "nearer beams are not looked at");
  fields("range_max_m", config.range_max_m, {0.1, 1000.0}, "farther beams are not looked at");
  fields.section("radius", config.radius);
  fields("tolerance_m", config.tolerance_m, {0.001, 1.0}, "half the width of an arm");
  fields("min_points", config.min_points, {1, 1000}, "least neighbours on each arm");
  fields("score", config.score, {"explained", "balance"},
         "share of the neighbours on the arms, or the library's balance of both arms");
  fields("min_score", config.min_score, {0.0, 1000.0}, "least score");
  fields("nms_radius_m", config.nms_radius_m, {0.0, 10.0}, "only the best keypoint within this is kept");
}

Result<OcConfig> oc_preset(std::string_view name) {
  if (name == "beaconless") return OcConfig{};
  if (name == "authors")
    return OcConfig{.range_max_m = 10.0,
                    .radius = {.at_zero_m = 0.1, .growth_per_m = 0.07},
                    .tolerance_m = 0.1,
                    .score = OcScore::balance,
                    .min_score = 1.0,
                    .nms_radius_m = 0.1};
  return Error{"oc preset \"" + std::string(name) + "\"", "there is no such preset",
               "use beaconless or authors"};
}

}  // namespace beaconless
