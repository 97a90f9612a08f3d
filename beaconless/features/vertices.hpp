// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"

namespace beaconless {

/// When a vertex of a scan's polyline counts as a corner.
struct VerticesConfig {
  bool is_segmented_first = true;           ///< or is the whole scan split at once?
  DistanceSegmentationConfig segmentation;  ///< what parts objects
  SplitConfig splitting{.epsilon_m = 0.10};
  double min_angle_deg = 30.0;  ///< by which the polyline turns there
  double min_arm_m = 0.20;      ///< a vertex beside a shorter piece is no corner
};

void describe(Fields& fields, VerticesConfig& config);

/// Buffers that live on from scan to scan.
struct VerticesScratch {
  DistanceSegmentationScratch segmentation;
  SplitScratch splitting;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
};

/// The vertices that Douglas and Peucker keep of a scan, where two long pieces meet at an angle.
///
/// Out: in the order of their beams; each is a beam with all its noise, up to epsilon_m beside the corner;
/// orientation is the bisector between both pieces, scale the shorter of them, score the angle by which the
/// polyline turns. Cost: that of segmentation and split. Source: dissertation 2.1.1, Algorithm 2, and 4.4.1
/// ("using only Douglas-Peucker algorithm to extract corners"). Differs: the ends of segments are no corners,
/// since they are where one thing hides another; the dissertation does not say whether it kept them.
void find_vertices(const Scan& scan, const VerticesConfig& config, VerticesScratch& scratch,
                   std::vector<Keypoint>& keypoints);
std::vector<Keypoint> find_vertices(const Scan& scan, const VerticesConfig& config = {});

}  // namespace beaconless
