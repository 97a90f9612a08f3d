// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "beaconless/features/flirt_support.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// Kernels and room for every scale; only when the config is another than last time.
void prepare(const FlirtConfig& config, FlirtScratch& scratch) {
  if (!scratch.kernels.empty() && scratch.prepared_for == config) return;
  const auto scales = static_cast<std::size_t>(std::max(config.scales_count, 1));
  scratch.kernels.clear();
  scratch.kernels.reserve(scales);
  for (std::size_t scale = 0; scale < scales; ++scale) {
    const double step = std::pow(config.scale_step_ratio, static_cast<double>(scale));
    if (config.kind == FlirtKind::curvature) {
      // Cells are parts of sigma, so that the kernel is the same on each scale.
      scratch.kernels.push_back(make_scale_kernel(FlirtKernel::sampled_gaussian, kCellsPerSigma));
      scratch.kernels.back().sigma = config.sigma_m * step;
    } else {
      scratch.kernels.push_back(make_scale_kernel(config.kernel, config.sigma_beams * step));
    }
  }
  scratch.smooth.resize(scales);
  scratch.response.resize(scales);
  scratch.move_x_m.resize(scales);
  scratch.move_y_m.resize(scales);
  scratch.prepared_for = config;
}

/// How many points a closed contour repeats at its ends, so that no core point feels them.
std::size_t halo(const Scan& scan, const FlirtConfig& config, const FlirtScratch& scratch) {
  if (config.kind == FlirtKind::curvature) return scan.size() / 2;
  return scratch.kernels.back().half_width() + scratch.kernels.front().half_width() +
         static_cast<std::size_t>(config.window_beams) + 2;
}

void respond_to_signal(const FlirtConfig& config, FlirtScratch& s) {
  if (config.kind == FlirtKind::range)
    s.signal.assign(s.contour.range_m.begin(), s.contour.range_m.end());
  else
    wall_directions(s.contour, s.kernels.front(), static_cast<std::size_t>(config.window_beams), s.normals,
                    s.signal);
  for (std::size_t scale = 0; scale < s.kernels.size(); ++scale) {
    s.smooth[scale].resize(s.signal.size());
    s.response[scale].resize(s.signal.size());
    for (const FlirtStretch& stretch : s.contour.stretches) {
      const auto signal = std::span(s.signal).subspan(stretch.begin, stretch.size());
      const auto smooth = std::span(s.smooth[scale]).subspan(stretch.begin, stretch.size());
      const auto response = std::span(s.response[scale]).subspan(stretch.begin, stretch.size());
      smooth_signal(signal, s.kernels[scale], s.padded, smooth);
      if (config.kind == FlirtKind::normal_edge)
        first_derivative(smooth, s.kernels[scale], response);
      else
        second_derivative(smooth, s.kernels[scale], response);
    }
  }
}

void respond_to_bends(FlirtScratch& s) {
  measure_contour(s.contour, 4.0 * s.kernels.back().sigma, s.curvature);
  for (std::size_t scale = 0; scale < s.kernels.size(); ++scale) {
    const double sigma_m = s.kernels[scale].sigma;
    std::vector<float>& response = s.response[scale];
    s.move_x_m[scale].resize(s.contour.size());
    s.move_y_m[scale].resize(s.contour.size());
    response.assign(s.contour.size(), 0.0F);
    for (const FlirtStretch& stretch : s.contour.stretches) {
      contour_moves(s.contour, stretch, sigma_m, s.kernels[scale], s.curvature, s.move_x_m[scale],
                    s.move_y_m[scale]);
      // Near open ends smoothing pulls inwards whatever the shape.
      const auto apart_m = static_cast<float>(stretch.closed ? 0.0 : 2.0 * sigma_m);
      const float length_m = s.curvature.along_m[stretch.end - 1];
      for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
        const float along_m = s.curvature.along_m[i];
        if (along_m < apart_m || along_m > length_m - apart_m) continue;
        const float dx = s.move_x_m[scale][i];
        const float dy = s.move_y_m[scale][i];
        const float t = static_cast<float>(2.0 / sigma_m) * std::sqrt(dx * dx + dy * dy);
        response[i] = t * std::exp(-t);
      }
    }
  }
}

/// Where the keypoint of a peak stands.
std::size_t place_of(const FlirtConfig& config, const FlirtStretch& stretch, const FlirtPeak& peak,
                     const FlirtScratch& s) {
  if (config.kind == FlirtKind::curvature) return peak.point;
  if (config.foreground == FlirtForeground::next_beam)
    return nearer_neighbour(s.contour, stretch, peak.point);
  // The lobes that a step makes lie one sigma from it. Of an edge, which a step makes as wide as the window,
  // nothing is left behind it; of a blob the lobe behind the step is where the wall there begins.
  const double window_beams = config.kind == FlirtKind::normal_edge ? 0.5 * config.window_beams : 0.0;
  const double reach_beams = 1.5 * s.kernels[peak.scale].sigma + window_beams;
  const FlirtSupport support = support_of(stretch, peak.point, reach_beams);
  return near_side(s.contour, support, peak.point, config.min_step_m);
}

Keypoint make_keypoint(const FlirtConfig& config, const FlirtStretch& stretch, const FlirtPeak& peak,
                       std::size_t at, const FlirtScratch& s) {
  Keypoint keypoint{.beam = s.contour.beam[at],
                    .point = {s.contour.x_m[at], s.contour.y_m[at]},
                    .score = static_cast<double>(peak.strength)};
  const double sigma = s.kernels[peak.scale].sigma;
  if (config.kind == FlirtKind::curvature) {
    keypoint.orientation_rad =
        wrap_angle(std::atan2(static_cast<double>(s.move_y_m[peak.scale][peak.point]),
                              static_cast<double>(s.move_x_m[peak.scale][peak.point])));
    keypoint.scale_m = 2.0 * sigma;
    return keypoint;
  }
  const FlirtSupport support = support_of(stretch, peak.point, sigma);
  double farthest_m2 = 0.0;
  for (std::size_t i = support.begin; i < support.end; ++i)
    farthest_m2 = std::max(
        farthest_m2, (Eigen::Vector2d(s.contour.x_m[i], s.contour.y_m[i]) - keypoint.point).squaredNorm());
  keypoint.scale_m = std::sqrt(farthest_m2);
  keypoint.orientation_rad = config.kind == FlirtKind::range
                                 ? support_direction(s.contour, support.begin, support.end)
                                 : wrap_angle(static_cast<double>(s.signal[peak.point]));
  return keypoint;
}

/// Whether a place is too near to a keypoint that was kept.
bool is_taken(const FlirtConfig& config, float x_m, float y_m, const FlirtScratch& s) {
  using Places = Eigen::Map<const Eigen::ArrayXf>;
  const auto count = static_cast<Eigen::Index>(s.kept_x_m.size());
  if (count == 0) return false;
  const auto dx = Places(s.kept_x_m.data(), count) - x_m;
  const auto dy = Places(s.kept_y_m.data(), count) - y_m;
  const auto apart_m = static_cast<float>(config.suppress_m);
  // Without leaving early: all distances at once are faster than one after the other.
  if (config.suppression == FlirtSuppression::box) return dx.abs().max(dy.abs()).minCoeff() <= apart_m;
  return (dx.square() + dy.square()).minCoeff() <= apart_m * apart_m;
}

}  // namespace

void detect_flirt(const Scan& scan, const FlirtConfig& config, FlirtScratch& s,
                  std::vector<Keypoint>& keypoints) {
  keypoints.clear();
  prepare(config, s);

  // 1. The hits, stretch by stretch. 2. Their response on every scale.
  gather_contour(scan, config.kind == FlirtKind::curvature ? config.max_gap_m : 0.0, halo(scan, config, s),
                 s.contour);
  if (config.kind == FlirtKind::curvature)
    respond_to_bends(s);
  else
    respond_to_signal(config, s);

  // 3. Peaks, in the order in which they may stay.
  const FlirtPeakRule rule{static_cast<float>(config.min_response), static_cast<float>(config.min_prominence),
                           config.falling_only, config.peaks_across_scales};
  s.peaks.clear();
  for (std::size_t stretch = 0; stretch < s.contour.stretches.size(); ++stretch)
    find_peaks(s.response, s.kernels, s.contour.stretches[stretch], static_cast<std::uint32_t>(stretch), rule,
               s.peaks);
  const bool strongest = config.order == FlirtOrder::strongest;
  std::sort(s.peaks.begin(), s.peaks.end(), [strongest](const FlirtPeak& a, const FlirtPeak& b) {
    if (strongest && a.strength != b.strength) return a.strength > b.strength;
    return a.scale != b.scale ? a.scale < b.scale : a.point < b.point;
  });

  // 4. Keypoints, each on the nearer surface and at a distance from all before it.
  s.kept_x_m.clear();
  s.kept_y_m.clear();
  for (const FlirtPeak& peak : s.peaks) {
    const FlirtStretch& stretch = s.contour.stretches[peak.stretch];
    const std::size_t at = place_of(config, stretch, peak, s);
    if (is_taken(config, s.contour.x_m[at], s.contour.y_m[at], s)) continue;
    keypoints.push_back(make_keypoint(config, stretch, peak, at, s));
    s.kept_x_m.push_back(s.contour.x_m[at]);
    s.kept_y_m.push_back(s.contour.y_m[at]);
  }
}

std::vector<Keypoint> detect_flirt(const Scan& scan, const FlirtConfig& config) {
  FlirtScratch scratch;
  std::vector<Keypoint> keypoints;
  detect_flirt(scan, config, scratch, keypoints);
  return keypoints;
}

}  // namespace beaconless
