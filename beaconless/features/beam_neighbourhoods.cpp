// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/beam_neighbourhoods.hpp"

#include <algorithm>

#include "beaconless/features/four_floats.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kBlock = 4;
constexpr float kAnything = 1e30F;

/// How far off the farthest places within the radius are, for four places side by side.
struct Reach {
  Ints4 before{};
  Ints4 after{};
};

/// All four at once, from the rim of the widest window inwards until each has one on both sides.
Reach farthest(const float* x, const float* y, const Floats4& radius_squared, std::int32_t window) {
  const Floats4 here_x = load4(x);
  const Floats4 here_y = load4(y);
  const auto near = [&](std::ptrdiff_t offset) -> Ints4 {
    const Floats4 dx = load4(x + offset) - here_x;
    const Floats4 dy = load4(y + offset) - here_y;
    return dx * dx + dy * dy <= radius_squared;
  };
  Reach far;
  for (std::int32_t offset = window; offset > 0; --offset) {
    const Ints4 open_before = far.before == 0;
    const Ints4 open_after = far.after == 0;
    if (!any(open_before | open_after)) break;
    far.before |= near(-offset) & open_before & offset;
    far.after |= near(offset) & open_after & offset;
  }
  return far;
}

}  // namespace

void BeamNeighbourhoods::assign(const Scan& scan, const KeypointRadius& radius) {
  const auto beams_per_rad = static_cast<float>(1.0 / scan.angle_increment_rad());
  points.assign(scan, most_beams_within(beams_per_rad) + kBlock);
  for (auto* of : {&first, &last}) of->resize(points.size());
  window.resize(points.size());
  radius_m.resize(points.size());

  // 1. radius and window of each; without a hit there is no window
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    radius_m[points.begin() + beam] = scan.is_hit(beam) ? radius.at(scan.ranges_m()[beam]) : 0.0F;
  const float* const ranges = scan.ranges_m().data();
  const float* const radii = radius_m.data() + points.begin();
  std::int32_t* const windows = window.data() + points.begin();
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    windows[beam] = beams_within(radii[beam], std::max(ranges[beam], 1e-9F), beams_per_rad);
  // 2. what they reach
  for (std::size_t begin = points.begin(); begin < points.end(); begin += kBlock)
    assign_block(begin, std::min(kBlock, points.end() - begin));
}

void BeamNeighbourhoods::assign_block(std::size_t begin, std::size_t count) {
  Floats4 radius_squared{};
  std::int32_t widest = 0;
  for (std::size_t lane = 0; lane < count; ++lane) {
    // a place without a hit is content with itself
    radius_squared[lane] =
        window[begin + lane] == 0 ? 1e30F : radius_m[begin + lane] * radius_m[begin + lane];
    widest = std::max(widest, window[begin + lane]);
  }
  // 1. the farthest on both sides; places without a hit are at the origin, which is always too far
  const float* const x = points.x_m.data() + begin;
  const float* const y = points.y_m.data() + begin;
  const Reach far = farthest(x, y, radius_squared, widest);
  // 2. but not beyond a gap
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t place = begin + lane;
    first[place] = static_cast<std::uint32_t>(place) - static_cast<std::uint32_t>(far.before[lane]);
    last[place] = static_cast<std::uint32_t>(place) + static_cast<std::uint32_t>(far.after[lane]);
    if (first[place] >= points.run_first[place] && last[place] <= points.run_last[place]) continue;
    if (!points.is_hit(place)) continue;
    for (first[place] = std::max(first[place], points.run_first[place]); !has(place, first[place]);)
      ++first[place];
    for (last[place] = std::min(last[place], points.run_last[place]); !has(place, last[place]);)
      --last[place];
  }
}

}  // namespace beaconless
