// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/segment_by_distance.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/features/segment_runs.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr double kFlattest_rad = 0.001;  // a wall met at a lesser angle is not told from a jump

/// A pair is cut when D² exceeds (offset + slope r)², with r the lesser range.
struct LinearThreshold {
  double offset_m = 0.0;
  double slope = 0.0;
};

LinearThreshold linear_threshold(const DistanceSegmentationConfig& config, double step_rad) {
  const double noise_m = 3.0 * std::sqrt(2.0) * config.sigma_m;
  switch (config.threshold) {
    case DistanceThreshold::constant:
      return {config.constant_m, 0.0};
    case DistanceThreshold::dietmayer:
      return {noise_m, 2.0 * std::sin(0.5 * step_rad)};
    case DistanceThreshold::santos: {
      const double from_pole = 0.5 * kPi - radians(config.beta_deg) - 0.5 * step_rad;
      return {noise_m, std::sin(step_rad) / std::sin(std::max(from_pole, kFlattest_rad))};
    }
    case DistanceThreshold::borges_aldon: {
      const double from_pole = radians(config.lambda_deg) - step_rad;
      return {3.0 * config.sigma_m, std::sin(step_rad) / std::sin(std::max(from_pole, kFlattest_rad))};
    }
    case DistanceThreshold::lee:
      break;
  }
  return {0.0, 2.0 * config.lee_ratio};
}

/// Whether two ranges are cut apart; a range of 0 is no hit and always is. Both forms in plain floats without
/// branches, so that compilers vectorise the loop over the scan.
struct ByDistance {
  float offset_m;
  float slope;
  float half_chord;  // 4 sin²(Δθ/2)

  std::uint8_t operator()(float p, float q) const {
    const float difference = p - q;
    const float product = p * q;
    const float reach = offset_m + slope * std::min(p, q);
    const bool is_near = difference * difference + half_chord * product <= reach * reach;
    return static_cast<std::uint8_t>(!is_near) | static_cast<std::uint8_t>(!(product > 0.0F));
  }
};

struct ByRatio {
  float ratio;

  bool operator()(float p, float q) const { return !(std::abs(p - q) <= ratio * (p + q) && p * q > 0.0F); }
};

/// breaks[i]: whether a segment ends with beam i.
template <class IsBreak>
void find_breaks(const Scan& scan, const IsBreak& is_break, std::vector<std::uint8_t>& breaks) {
  const std::size_t n = scan.size();
  breaks.resize(n);
  const float* const range = scan.ranges_m().data();
  std::uint8_t* const out = breaks.data();
  for (std::size_t i = 0; i + 1 < n; ++i) out[i] = is_break(range[i], range[i + 1]);
  const bool closes = scan.is_full_circle() && n > 1;
  out[n - 1] = closes ? is_break(range[n - 1], range[0]) : std::uint8_t{1};
}

}  // namespace

void describe(Fields& fields, DistanceSegmentationConfig& config) {
  fields("threshold", config.threshold, {"constant", "dietmayer", "santos", "borges-aldon", "lee"},
         "how far apart neighbouring beams of one object may end");
  fields("sigma_m", config.sigma_m, {0.0, 1.0}, "standard deviation of the laser's ranges");
  fields("constant_m", config.constant_m, {0.001, 100.0}, "the constant threshold");
  fields("beta_deg", config.beta_deg, {0.0, 89.9}, "santos: most that a wall may be turned from head-on");
  fields("lambda_deg", config.lambda_deg, {0.1, 89.9},
         "borges-aldon: least angle between a beam and the wall it meets");
  fields("lee_ratio", config.lee_ratio, {1e-4, 1.0}, "lee: difference of two ranges by their sum");
  fields("min_beams", config.min_beams, {1, 1000000}, "segments of fewer beams are left out");
}

double distance_threshold_m(const DistanceSegmentationConfig& config, double angle_increment_rad,
                            double range_m) {
  const LinearThreshold threshold = linear_threshold(config, angle_increment_rad);
  return threshold.offset_m + threshold.slope * range_m;
}

void segment_by_distance(const Scan& scan, const DistanceSegmentationConfig& config,
                         DistanceSegmentationScratch& scratch, std::vector<ScanSegment>& segments) {
  // 1. Where neighbours part.
  if (config.threshold == DistanceThreshold::lee) {
    find_breaks(scan, ByRatio{static_cast<float>(config.lee_ratio)}, scratch.breaks);
  } else {
    const LinearThreshold threshold = linear_threshold(config, scan.angle_increment_rad());
    const double half = std::sin(0.5 * scan.angle_increment_rad());
    find_breaks(scan,
                ByDistance{static_cast<float>(threshold.offset_m), static_cast<float>(threshold.slope),
                           static_cast<float>(4.0 * half * half)},
                scratch.breaks);
  }
  // 2. The runs between.
  segments_from_breaks(scan, scratch.breaks, static_cast<std::size_t>(std::max(1, config.min_beams)),
                       segments);
}

std::vector<ScanSegment> segment_by_distance(const Scan& scan, const DistanceSegmentationConfig& config) {
  DistanceSegmentationScratch scratch;
  std::vector<ScanSegment> segments;
  segment_by_distance(scan, config, scratch, segments);
  return segments;
}

}  // namespace beaconless
