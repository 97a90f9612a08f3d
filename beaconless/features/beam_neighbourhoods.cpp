// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/beam_neighbourhoods.hpp"

#include <algorithm>

#include "beaconless/features/four_floats.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kBlock = 4;
constexpr float kAnything = 1e30F;  // no squared distance is greater

/// How far off the farthest places within the radius are, for four places side by side.
struct Reach {
  Ints4 before{};
  Ints4 after{};
};

/// `offset` where that place is near, else offset - 1 where that one is, else 0.
Ints4 farther(const Ints4& at_offset, const Ints4& before_it, std::int32_t offset) {
  return (at_offset & offset) | (~at_offset & before_it & (offset - 1));
}

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
  // two steps at a time: the question whether to go on costs as much as a step
  for (std::int32_t offset = window; offset > 0; offset -= 2) {
    const Ints4 open_before = far.before == 0;
    const Ints4 open_after = far.after == 0;
    if (!any(open_before | open_after)) break;
    far.before |= open_before & farther(near(-offset), near(1 - offset), offset);
    far.after |= open_after & farther(near(offset), near(offset - 1), offset);
  }
  return far;
}

}  // namespace

void BeamNeighbourhoods::assign(const Scan& scan, const KeypointRadius& radius) {
  const auto beams_per_rad = static_cast<float>(1.0 / scan.angle_increment_rad());
  const auto others = static_cast<std::int32_t>(scan.size()) - 1;
  points.assign(scan, std::min<std::size_t>(most_beams_within(beams_per_rad), scan.size()) + kBlock);
  for (auto* of : {&first, &last}) of->resize(points.size());
  window.resize(points.size());
  radius_m.resize(points.size());

  // 1. radius and window of each; without a hit both are nothing
  const float* const ranges = scan.ranges_m().data();
  float* const radii = radius_m.data() + points.begin();
  std::size_t beam = 0;
  for (; beam + kBlock <= scan.size(); beam += kBlock) store4(radius.at(load4(ranges + beam)), radii + beam);
  for (; beam < scan.size(); ++beam) radii[beam] = radius.at(ranges[beam]);
  std::int32_t* const windows = window.data() + points.begin();
  for (beam = 0; beam < scan.size(); ++beam)
    windows[beam] = std::min(beams_within(radii[beam], std::max(ranges[beam], 1e-9F), beams_per_rad), others);
  // 2. what they reach
  for (std::size_t begin = points.begin(); begin < points.end(); begin += kBlock)
    assign_block(begin, std::min(kBlock, points.end() - begin));
}

void BeamNeighbourhoods::assign_block(std::size_t begin, std::size_t count) {
  // a place without a hit takes the first that comes, so that the others need not wait for it
  Floats4 radius_squared = Floats4{} + kAnything;
  std::int32_t widest = 0;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const float radius = radius_m[begin + lane];
    if (radius > 0.0F) radius_squared[lane] = radius * radius;
    widest = std::max(widest, window[begin + lane]);
  }
  // 1. the farthest on both sides; places without a hit are at the origin, which is always too far
  const float* const x = points.x_m.data() + begin;
  const float* const y = points.y_m.data() + begin;
  const Reach far = farthest(x, y, radius_squared, widest);
  const auto place = static_cast<std::int32_t>(begin);
  const Ints4 places = {place, place + 1, place + 2, place + 3};
  store4(places - far.before, first.data() + begin);
  store4(places + far.after, last.data() + begin);
  // 2. but not beyond a gap
  const Ints4 over = (places - far.before < load4(points.run_first.data() + begin)) |
                     (places + far.after > load4(points.run_last.data() + begin));
  if (any(over)) cut_at_gaps(begin, count);
}

void BeamNeighbourhoods::cut_at_gaps(std::size_t begin, std::size_t count) {
  for (std::size_t place = begin; place < begin + count; ++place) {
    if (!points.is_hit(place)) continue;
    for (first[place] = std::max(first[place], points.run_first[place]); !has(place, first[place]);)
      ++first[place];
    for (last[place] = std::min(last[place], points.run_last[place]); !has(place, last[place]);)
      --last[place];
  }
}

}  // namespace beaconless
