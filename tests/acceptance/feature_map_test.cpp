// SPDX-License-Identifier: Apache-2.0
// Whether a map's features are those that scans show: each scan's finds, put where its true pose says,
// against the nearest feature of the map that is turned alike. Skipped where the recordings are not.
#include "beaconless/match/feature_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless {
namespace {

constexpr double kNear_m = 0.05;

struct Case {
  const char* name;
  const char* map;
  Detector detector;
  double found_share;  ///< asked, within kNear_m
  double median_m;     ///< allowed, of those found
};

void PrintTo(const Case& asked, std::ostream* out) { *out << asked.name; }

std::string name_of(const testing::TestParamInfo<Case>& asked) { return asked.param.name; }

/// The distance to the nearest feature that is turned alike.
double distance_m(const FeatureMap& map, const Eigen::Vector2d& point, double orientation_rad) {
  double least = std::numeric_limits<double>::infinity();
  map.places.for_each_within(point, kNear_m, [&](std::size_t i) {
    const PointFeature& feature = map.features[i];
    if (std::abs(wrap_angle(feature.orientation_rad - orientation_rad)) < radians(25.0))
      least = std::min(least, (feature.point - point).norm());
  });
  return least;
}

class FeaturesOfAMap : public testing::TestWithParam<Case> {};

TEST_P(FeaturesOfAMap, AreThoseThatScansShow) {
  const Case& asked = GetParam();
  const std::string drive = recorded("sim_rooms/b1_ellipse.carmen.log.gz");
  if (drive.empty()) GTEST_SKIP() << "sim_rooms is not here; BEACONLESS_DATA names its folder";
  const Map map = io::read_map(recorded(std::string("sim_rooms/") + asked.map)).value();
  const FeatureMap features = build_feature_map(map, asked.detector).value();
  const auto truth = io::read_tum(recorded("sim_rooms/b1_ellipse.truth.tum")).value();

  PointFeaturesScratch scratch;
  std::vector<PointFeature> found;
  std::vector<double> distances_m;
  std::size_t all = 0;
  std::size_t index = 0;
  for (const Event& event : io::open_recording(drive).value()) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    const Pose2& map_from_laser = truth[index++].pose;
    if (index % 4 != 0) continue;
    find_point_features(*scan, asked.detector, {}, scratch, found);
    for (const PointFeature& feature : found) {
      const double off = distance_m(features, map_from_laser * feature.point,
                                    feature.orientation_rad + map_from_laser.theta_rad);
      if (off <= kNear_m) distances_m.push_back(off);
      ++all;
    }
  }
  ASSERT_GT(all, 1000U);
  std::sort(distances_m.begin(), distances_m.end());
  EXPECT_GE(static_cast<double>(distances_m.size()) / static_cast<double>(all), asked.found_share);
  EXPECT_LE(distances_m[distances_m.size() / 2], asked.median_m);
}

// A third of the corners that a laser shows in this room are where a cupboard's side and the wall behind it
// cross: without those the share is 0.64. FALKO finds points all over the round column, which stay nowhere.
// Medians allowed: what two scans of the drive differ by (5 mm for corners), and half a cell more on the
// grid.
INSTANTIATE_TEST_SUITE_P(
    Maps, FeaturesOfAMap,
    testing::Values(Case{"corners_plan", "b_room12x8.plan.yaml", Detector::corners, 0.98, 0.005},
                    Case{"oc_plan", "b_room12x8.plan.yaml", Detector::oc, 0.95, 0.005},
                    Case{"falko_plan", "b_room12x8.plan.yaml", Detector::falko, 0.75, 0.007},
                    Case{"corners_grid", "b_room12x8_r050.yaml", Detector::corners, 0.95, 0.030},
                    Case{"falko_grid", "b_room12x8_r050.yaml", Detector::falko, 0.70, 0.030}),
    name_of);

}  // namespace
}  // namespace beaconless
