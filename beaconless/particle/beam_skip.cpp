// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/beam_skip.hpp"

#include <algorithm>

namespace beaconless {
namespace {

/// The byte of the field at a place; that of the rim where it is off the table.
std::uint8_t byte_at(const LikelihoodField& field, const Eigen::Vector2d& point_map) {
  const Eigen::Vector2d place = (point_map - field.low()) / field.cell_m();
  const bool is_inside = place.x() > 0.0 && place.y() > 0.0 && place.x() < field.width_cells() &&
                         place.y() < field.height_cells();
  if (!is_inside) return 0;
  return field.bytes()[static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(field.width_cells()) +
                       static_cast<std::size_t>(place.x())];
}

}  // namespace

void skip_beams(const Particles& particles, const Pose2& base_from_laser, const LikelihoodField& field,
                const AmclConfig& config, BeamEnds& ends) {
  const std::uint8_t near = field.byte_of(config.beam_skip_distance);
  const double enough = config.beam_skip_threshold * static_cast<double>(particles.size());
  // Those kept move to the front, the others to the back, so that all are still there if too few are kept.
  std::size_t kept = 0;
  for (std::size_t beam = 0; beam < ends.size(); ++beam) {
    const Eigen::Vector2d end(static_cast<double>(ends.x_m[beam]), static_cast<double>(ends.y_m[beam]));
    double explained = 0.0;
    for (std::size_t i = 0; i < particles.size() && explained <= enough; ++i)
      if (byte_at(field, particles.pose(i) * base_from_laser * end) >= near) explained += 1.0;
    if (explained <= enough) continue;
    std::swap(ends.x_m[kept], ends.x_m[beam]);
    std::swap(ends.y_m[kept], ends.y_m[beam]);
    ++kept;
  }
  const auto skipped = static_cast<double>(ends.size() - kept);
  if (skipped > config.beam_skip_error_threshold * static_cast<double>(ends.size())) return;
  ends.x_m.resize(kept);
  ends.y_m.resize(kept);
}

}  // namespace beaconless
