// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_config.hpp"

namespace beaconless {

void describe(Fields& fields, FlirtConfig& config) {
  fields("kind", config.kind, {"range", "normal-blob", "normal-edge", "curvature"},
         "which signal along the scan keypoints are extrema of");
  fields("kernel", config.kernel, {"sampled-gaussian", "discrete-gaussian", "flirtlib-bessel"},
         "how range, blob and edge are smoothed; flirtlib-bessel takes sigma for a variance");
  fields("sigma_beams", config.sigma_beams, {0.1, 10.0}, "finest scale of range, blob and edge");
  fields("sigma_m", config.sigma_m, {0.01, 10.0}, "finest scale of curvature");
  fields("scale_step_ratio", config.scale_step_ratio, {1.01, 2.0}, "from one scale to the next");
  fields("scales_count", config.scales_count, {1, 10}, "number of scales");
  fields("window_beams", config.window_beams, {3, 101}, "points that a normal is fitted to; odd");
  fields("min_response", config.min_response, {0.0, 100.0},
         "weakest peak: m for range, rad for blob and edge, at most 0.3679 for curvature");
  fields("min_prominence", config.min_prominence, {0.0, 100.0},
         "by how much a peak exceeds its neighbours along the scan");
  fields("falling_only", config.falling_only, "only responses of one sign");
  fields("peaks_across_scales", config.peaks_across_scales, "a peak also exceeds the neighbouring scales");
  fields("order", config.order, {"strongest", "finest"}, "which of two neighbouring keypoints stays");
  fields("suppression", config.suppression, {"disc", "box"},
         "how nearness is measured; box depends on the heading");
  fields("suppress_m", config.suppress_m, {0.0, 10.0}, "keypoints are further apart than this");
  fields("foreground", config.foreground, {"support", "next-beam"},
         "where a keypoint at a step stands: at its near side, or at the next beam if that is nearer");
  fields("min_step_m", config.min_step_m, {0.0, 100.0},
         "ranges of neighbouring beams that differ by more belong to two surfaces");
  fields("max_gap_m", config.max_gap_m, {0.0, 100.0},
         "curvature: points further apart end a contour; 0: none does");
}

FlirtConfig flirt_defaults(FlirtKind kind) {
  FlirtConfig config;
  config.kind = kind;
  switch (kind) {
    case FlirtKind::range:
      break;
    case FlirtKind::normal_blob:
      config.sigma_beams = 2.0;
      config.scale_step_ratio = 1.5;
      config.scales_count = 4;
      config.window_beams = 11;
      config.min_response = 0.16;
      break;
    case FlirtKind::normal_edge:
      config.sigma_beams = 1.6;
      config.scales_count = 4;
      config.window_beams = 11;
      config.min_response = 0.2;
      break;
    case FlirtKind::curvature:
      config.min_response = 0.34;
      config.order = FlirtOrder::finest;  // t exp(-t) is flat at its top: the strongest is any of them
      break;
  }
  return config;
}

FlirtConfig flirtlib_tools(FlirtKind kind) {
  FlirtConfig config;
  config.kind = kind;
  config.kernel = FlirtKernel::flirtlib_bessel;
  config.sigma_beams = kind == FlirtKind::range ? 1.6 : 0.2;
  config.sigma_m = 0.2;
  config.min_response = 0.34;
  config.min_prominence = 0.001;
  config.falling_only = kind == FlirtKind::normal_edge;
  config.peaks_across_scales = false;
  config.order = FlirtOrder::finest;
  config.suppression = FlirtSuppression::box;
  config.foreground = FlirtForeground::next_beam;
  return config;
}

}  // namespace beaconless
