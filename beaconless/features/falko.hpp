// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/angle_sectors.hpp"
#include "beaconless/features/beam_neighbourhoods.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/keypoint_radius.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// Where the keypoint is put.
enum class SubBeam : int {
  off,            ///< at the beam
  neighbourhood,  ///< where lines through both sides of the neighbourhood meet, the beam on both, as the
                  ///< authors do
  arms,           ///< where lines through longer sides meet, grown as far as they stay straight
};

/// FALKO; the defaults are this project's, see falko_preset() for those of others.
struct FalkoConfig {
  double range_min_m = 0.0;
  double range_max_m = 30.0;
  KeypointRadius radius{.at_zero_m = 0.25, .growth_per_m = 0.07};
  int min_points = 2;
  int max_points = 8;
  double base_ratio = 2.0;
  int sectors = 16;
  bool centred_sectors = true;
  double min_score_percent = 50.0;
  double nms_radius_m = 0.25;
  SubBeam subbeam = SubBeam::arms;
  double subbeam_limit_m = 0.2;
  double arm_m = 1.0;
  double sigma_m = 0.01;
};

void describe(Fields& fields, FalkoConfig& config);

/// The parameters of "beaconless" (the defaults), "authors" (the library of the paper) or "dissertation"
/// (Table 4.10); an Error for any other name.
Result<FalkoConfig> falko_preset(std::string_view name);

/// The neighbours on one side of a beam, as seen from it.
struct FalkoSide {
  std::vector<float> x;  ///< longer than `count` by what a vector load may run over
  std::vector<float> y;
  std::vector<float> sector;
  std::size_t count = 0;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();

  void make_room(std::size_t most) {
    for (auto* of : {&x, &y, &sector}) of->resize(most);
  }
  void clear() {
    count = 0;
    sum.setZero();
  }
  void add(float dx, float dy) {
    x[count] = dx;
    y[count] = dy;
    sum += Eigen::Vector2f(dx, dy);
    ++count;
  }
  Eigen::Vector2f mean() const { return sum / static_cast<float>(count); }
};

/// Buffers that live on from call to call.
struct FalkoScratch {
  static constexpr int kUntested = -1;

  BeamNeighbourhoods around;
  AngleSectors sectors;
  std::vector<int> raw;  ///< a beam: the disorder of its neighbourhood; kUntested where that is no triangle
  std::vector<Eigen::Vector2f> bisectors;  ///< a beam, where it was tested
  std::vector<Keypoint> candidates;
  FalkoSide left;
  FalkoSide right;
};

/// Finds corner-like points: both sides of the neighbourhood are straight, and they make a triangle with it.
///
/// In: a scan. Out: keypoints by beam; orientation is the bisector from the corner into the area between its
/// arms, scale the radius of the neighbourhood, score in [0, 1]. Cost: see docs/performance.md; allocates
/// nothing with the scratch of a scan of the same size.
///
/// Source: Kallasi, Lodi Rizzini and Caselli, "Fast Keypoint Features from Laser Scanner for Robot
/// Localization and Mapping", RA-L 2016, section III; dissertation Algorithm 7. Differs: (1) the orientation
/// is returned (the public getCornerOrientation ends without a return statement); (2) sectors are
/// compared around the circle (see AngleSectors) and centred on the bisector, since the arms of a right
/// angle lie exactly on the limits of uncentred ones; (3) of many neighbours only
/// some, evenly taken, are looked at, so that near corners do not score worse than far ones; (4) equal scores
/// are one plateau only within the suppression radius; (5) the window is symmetric and ends with the scan, or
/// goes round with a full circle; an invalid beam ends it; (6) the refinement leaves the corner's own beam
/// out.
std::vector<Keypoint> detect_falko(const Scan& scan, const FalkoConfig& config = {});
void detect_falko(const Scan& scan, const FalkoConfig& config, FalkoScratch& scratch,
                  std::vector<Keypoint>& keypoints);

}  // namespace beaconless
