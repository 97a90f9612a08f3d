// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/map/plan_corners.hpp"
#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kSameTurn_deg = 25.0;

FloorPlan plan_named(const std::string& name) {
  return std::get<FloorPlan>(
      io::read_map(std::string(BEACONLESS_SOURCE_DIR) + "/data/plans/" + name + ".yaml").value());
}

FeatureMap features_of(const Map& map, Detector detector, const FeatureMapConfig& config = {}) {
  auto built = build_feature_map(map, detector, {}, config);
  EXPECT_TRUE(built) << (built ? Error{} : built.error());
  return built ? std::move(built).value() : FeatureMap{};
}

double turn_deg(double a_rad, double b_rad) { return std::abs(degrees(wrap_angle(a_rad - b_rad))); }

/// The distance to the nearest of some places that is turned alike; infinity where there is none.
template <class Places>
double distance_m(const Places& places, const Eigen::Vector2d& point, double orientation_rad) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : places)
    if (turn_deg(place.orientation_rad, orientation_rad) <= kSameTurn_deg)
      least = std::min(least, (place.point - point).norm());
  return least;
}

/// How far features are from the nearest of some places, ascending.
template <class Places>
std::vector<double> distances_m(const std::vector<PointFeature>& features, const Places& places) {
  std::vector<double> distances;
  distances.reserve(features.size());
  for (const PointFeature& feature : features)
    distances.push_back(distance_m(places, feature.point, feature.orientation_rad));
  std::sort(distances.begin(), distances.end());
  return distances;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted.at(static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1)));
}

/// The share of features that have another of the same place and turn within `radius_m`.
double share_found(const std::vector<PointFeature>& wanted, const std::vector<PointFeature>& among,
                   double radius_m) {
  const auto found = std::count_if(wanted.begin(), wanted.end(), [&](const PointFeature& feature) {
    return distance_m(among, feature.point, feature.orientation_rad) <= radius_m;
  });
  return static_cast<double>(found) / static_cast<double>(wanted.size());
}

struct SmallRoom {
  Detector detector;
  double near_m;
  double turn_deg;
};

class FeatureMapOfASmallRoom : public testing::TestWithParam<SmallRoom> {};

TEST_P(FeatureMapOfASmallRoom, HasItsFourCorners) {
  const FeatureMap map = features_of(plan_named("small"), GetParam().detector);
  ASSERT_EQ(map.features.size(), 4U);
  ASSERT_EQ(map.evidence.size(), 4U);
  for (const double x : {0.0, 3.6})
    for (const double y : {0.0, 2.8}) {
      const double inwards = std::atan2(y > 0.0 ? -1.0 : 1.0, x > 0.0 ? -1.0 : 1.0);
      int near = 0;
      map.places.for_each_within({x, y}, GetParam().near_m, [&](std::size_t i) {
        const PointFeature& feature = map.features[i];
        EXPECT_LE(turn_deg(feature.orientation_rad, inwards), GetParam().turn_deg);
        if (GetParam().detector == Detector::corners) {
          EXPECT_NEAR(degrees(feature.opening_rad), 90.0, 1e-9);
        }
        EXPECT_GE(feature.covariance(0, 0), 0.99e-6);  // no map is better than a millimetre
        EXPECT_LE(feature.covariance(0, 0), 1e-4);
        EXPECT_GT(map.evidence[i].found_views, 30);
        EXPECT_GT(map.evidence[i].share, 0.5);
        ++near;
      });
      EXPECT_EQ(near, 1) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Detectors, FeatureMapOfASmallRoom,
                         testing::Values(SmallRoom{Detector::corners, 1e-9, 1e-6},
                                         SmallRoom{Detector::rdp, 1e-9, 1e-6},
                                         SmallRoom{Detector::oc, 0.002, 1.0},
                                         SmallRoom{Detector::falko, 0.01, 3.0}));

/// Medians and 95th percentiles of the distance from what is drawn, and how many there must be.
struct EmptiedRoom {
  Detector detector;
  double median_m;
  double p95_m;
  std::size_t fewest;
};

class FeatureMapOfTheEmptiedRoom : public testing::TestWithParam<EmptiedRoom> {};

TEST_P(FeatureMapOfTheEmptiedRoom, LiesOnItsCorners) {
  const FloorPlan plan = plan_named("room-emptied");
  const FeatureMap map = features_of(plan, GetParam().detector);
  const auto off = distances_m(map.features, find_plan_corners(plan));
  EXPECT_GE(map.features.size(), GetParam().fewest);
  EXPECT_LE(quantile(off, 0.5), GetParam().median_m);
  EXPECT_LE(quantile(off, 0.95), GetParam().p95_m);
  EXPECT_LE(off.back(), 0.05);  // none where no corner is
}

INSTANTIATE_TEST_SUITE_P(Detectors, FeatureMapOfTheEmptiedRoom,
                         testing::Values(EmptiedRoom{Detector::corners, 1e-9, 1e-9, 24},
                                         EmptiedRoom{Detector::rdp, 1e-9, 0.01, 22},
                                         EmptiedRoom{Detector::oc, 0.001, 0.005, 18},
                                         EmptiedRoom{Detector::falko, 0.005, 0.010, 22}));

TEST(FeatureMap, AClosetsCornersAreThoseOfItsOutside) {
  const auto features = features_of(plan_named("room-emptied"), Detector::corners).features;
  for (const auto& [x, y, deg] : {std::array{6.4, 8.0, -135.0}, std::array{8.8, 8.0, -45.0},
                                  std::array{6.4, 7.5, 45.0}, std::array{8.8, 7.5, 135.0}})
    EXPECT_LT(distance_m(features, {x, y}, radians(deg)), 1e-9) << x << " " << y;
  EXPECT_GT(distance_m(features, {6.4, 8.0}, radians(-45.0)), 0.3);  // nobody stands inside of it
}

class FeatureMapOfKeypoints : public testing::TestWithParam<Detector> {};

TEST_P(FeatureMapOfKeypoints, HasNothingOfWhatMovesWithTheViewer) {
  // A post in a hall: what it hides of the walls is another part from everywhere.
  FloorPlan plan = test::rectangle(9.0, 6.0);
  plan.walls.push_back({{4, 3}, {4.3, 3}, {4.3, 3.3}, {4, 3.3}, {4, 3}});
  const auto corners = find_plan_corners(plan);
  const auto built = build_feature_map(plan, GetParam());
  if (!built) return;  // a detector may find nothing that stays
  // Shadows of a few views may meet by chance; no more than that.
  int finds = 0;
  int stray_finds = 0;
  for (std::size_t i = 0; i < built->features.size(); ++i) {
    double least = 1e9;
    for (const PlanCorner& corner : corners)
      least = std::min(least, (corner.point - built->features[i].point).norm());
    finds += built->evidence[i].found_views;
    if (least > 0.35) stray_finds += built->evidence[i].found_views;
  }
  EXPECT_LE(stray_finds, finds / 50) << "of " << finds;
}

INSTANTIATE_TEST_SUITE_P(Detectors, FeatureMapOfKeypoints,
                         testing::Values(Detector::falko, Detector::oc, Detector::flirt_range,
                                         Detector::flirt_blob, Detector::flirt_edge,
                                         Detector::flirt_curvature));

TEST(FeatureMap, ACupboardsSideAndTheWallBehindItMakeACorner) {
  // Six centimetres off the wall, as cupboards stand; nobody sees behind it.
  FloorPlan plan = test::rectangle(8.0, 6.0);
  plan.walls.push_back({{3, 0.06}, {5, 0.06}, {5, 0.6}, {3, 0.6}, {3, 0.06}});
  const auto features = features_of(plan, Detector::corners).features;
  EXPECT_LT(distance_m(features, {3.0, 0.0}, radians(135.0)), 0.005);
  EXPECT_LT(distance_m(features, {5.0, 0.0}, radians(45.0)), 0.005);
  EXPECT_LT(distance_m(features, {3.0, 0.6}, radians(-45.0)), 1e-9);
}

TEST(FeatureMap, WallsWithThicknessHaveCornersOnTheInside) {
  FloorPlan plan = test::rectangle(8.0, 6.0);
  plan.walls.push_back({{-0.1, -0.1}, {8.1, -0.1}, {8.1, 6.1}, {-0.1, 6.1}, {-0.1, -0.1}});
  const auto features = features_of(plan, Detector::corners).features;
  ASSERT_EQ(features.size(), 4U);
  for (const PointFeature& feature : features)
    EXPECT_TRUE(feature.point.x() == 0.0 || feature.point.x() == 8.0);
}

TEST(FeatureMap, CornersWhereNoViewHasRoomAreKept) {
  // A passage half a metre wide behind a room, closed at its end.
  const FloorPlan plan{{{{0, 0}, {6, 0}, {6, 4}, {0, 4}, {0, 0}},
                        {{7, 0}, {7.5, 0}, {7.5, 1.5}, {9, 1.5}, {9, 2}, {7, 2}, {7, 0}}}};
  const auto features = features_of(plan, Detector::corners).features;
  EXPECT_LT(distance_m(features, {9.0, 1.5}, radians(135.0)), 1e-9);
  EXPECT_LT(distance_m(features, {0.0, 0.0}, radians(45.0)), 1e-9);
}

TEST(FeatureMap, TurnsAndMovesWithThePlan) {
  const FloorPlan plan = plan_named("room-emptied");
  const Pose2 moved_from_plan{100.0, -20.0, 1.9};
  FloorPlan moved = plan;
  for (FloorPlan::Polyline& wall : moved.walls)
    for (Eigen::Vector2d& point : wall) point = moved_from_plan * point;
  for (const Detector detector : {Detector::corners, Detector::falko}) {
    std::vector<PointFeature> features = features_of(plan, detector).features;
    for (PointFeature& feature : features) {
      feature.point = moved_from_plan * feature.point;
      feature.orientation_rad = wrap_angle(feature.orientation_rad + moved_from_plan.theta_rad);
    }
    const auto turned = features_of(moved, detector).features;
    // The views stand elsewhere, so that what few of them find may be found or not.
    const double near = detector == Detector::corners ? 1e-6 : 0.01;
    EXPECT_GE(share_found(features, turned, near), 0.8) << to_string(detector);
    EXPECT_GE(share_found(turned, features, near), 0.8) << to_string(detector);
  }
}

/// A grid's place relative to the walls.
struct Raster {
  double resolution_m;
  double heading_deg;
  double phase_cells;
};

class FeatureMapOfAGrid : public testing::TestWithParam<Raster> {};

TEST_P(FeatureMapOfAGrid, HasTheCornersOfThePlan) {
  const FloorPlan plan = plan_named("room-emptied");
  const auto [resolution, heading_deg, phase] = GetParam();
  const OccupancyGrid grid = rasterize(plan, {.resolution_m = resolution,
                                              .heading_rad = radians(heading_deg),
                                              .phase_x_cells = phase,
                                              .phase_y_cells = phase})
                                 .value();
  const auto exact = features_of(plan, Detector::corners).features;
  const auto corners = features_of(grid, Detector::corners).features;
  const auto off = distances_m(corners, exact);
  // Half a cell along either axis is what a grid may have lost for good.
  EXPECT_LE(quantile(off, 0.5), 0.5 * std::sqrt(2.0) * resolution);
  EXPECT_GE(share_found(exact, corners, 1.5 * resolution), 0.75);
  EXPECT_GE(share_found(corners, exact, 1.5 * resolution), 0.75);
  for (const PointFeature& corner : corners)
    EXPECT_GE(corner.covariance.trace(), 0.99 * 2.0 * resolution * resolution / 12.0);

  const auto keypoints = features_of(grid, Detector::falko).features;
  const auto exact_keypoints = features_of(plan, Detector::falko).features;
  EXPECT_LE(quantile(distances_m(keypoints, exact_keypoints), 0.5), 0.6 * std::sqrt(2.0) * resolution);
  EXPECT_GE(share_found(exact_keypoints, keypoints, 2.0 * resolution), 0.7);
}

INSTANTIATE_TEST_SUITE_P(Rasters, FeatureMapOfAGrid,
                         testing::Values(Raster{0.05, 0.0, 0.5}, Raster{0.05, 0.0, 0.1},
                                         Raster{0.05, 7.0, 0.3}, Raster{0.05, 33.0, 0.7},
                                         Raster{0.025, 0.0, 0.25}, Raster{0.025, 7.0, 0.3}));

TEST(FeatureMap, OfATurnedGridIsTheSameTurned) {
  OccupancyGrid grid = rasterize(test::niche_room()).value();
  auto features = features_of(grid, Detector::corners).features;
  const Pose2 move{4.0, -7.0, 2.2};
  grid.map_from_grid = move * grid.map_from_grid;
  for (PointFeature& feature : features) {
    feature.point = move * feature.point;
    feature.orientation_rad = wrap_angle(feature.orientation_rad + move.theta_rad);
  }
  const auto turned = features_of(grid, Detector::corners).features;
  EXPECT_GE(share_found(features, turned, 0.01), 0.8);
  EXPECT_GE(share_found(turned, features, 0.01), 0.8);
}

TEST(FeatureMap, KnowsWhatIsNotKnownOfTheMap) {
  const FloorPlan plan = plan_named("small");
  FeatureMapConfig config;
  config.map_sigma_m = 0.02;
  for (const PointFeature& feature : features_of(plan, Detector::corners, config).features)
    EXPECT_NEAR(feature.covariance(0, 0), 4e-4, 1e-6);
  const OccupancyGrid grid = rasterize(plan).value();
  for (const PointFeature& feature : features_of(grid, Detector::corners, config).features)
    EXPECT_GE(feature.covariance(0, 0), 4e-4);
}

TEST(FeatureMap, IsTheSameTwice) {
  const FloorPlan plan = plan_named("room-emptied");
  for (const Detector detector : {Detector::corners, Detector::falko, Detector::flirt_edge}) {
    const auto once = features_of(plan, detector).features;
    const auto twice = features_of(plan, detector).features;
    ASSERT_EQ(once.size(), twice.size());
    for (std::size_t i = 0; i < once.size(); ++i) {
      EXPECT_EQ(once[i].point, twice[i].point);
      EXPECT_EQ(once[i].covariance, twice[i].covariance);
      EXPECT_EQ(once[i].orientation_rad, twice[i].orientation_rad);
    }
  }
}

Error error_of(const Map& map, Detector detector, const FeatureMapConfig& config = {}) {
  const auto built = build_feature_map(map, detector, {}, config);
  EXPECT_FALSE(built);
  return built ? Error{} : built.error();
}

TEST(FeatureMap, OfAMapWithoutAnySaysSo) {
  EXPECT_NE(error_of(FloorPlan{}, Detector::corners).what.find("no walls"), std::string::npos);
  EXPECT_NE(error_of(OccupancyGrid{}, Detector::falko).what.find("no occupied cell"), std::string::npos);
  // One straight wall.
  const Error straight = error_of(FloorPlan{{{{0, 0}, {5, 0}}}}, Detector::falko);
  EXPECT_FALSE(straight.remedy.empty());
  // A round tower.
  FloorPlan tower{{{}}};
  for (int i = 0; i <= 720; ++i)
    tower.walls[0].emplace_back(5.0 * std::cos(radians(i / 2.0)), 5.0 * std::sin(radians(i / 2.0)));
  const Error round = error_of(tower, Detector::corners);
  EXPECT_NE(round.what.find("corners"), std::string::npos) << round;
  EXPECT_NE(round.remedy.find("icp-full"), std::string::npos) << round;
  // No room to look around.
  EXPECT_FALSE(error_of(test::rectangle(0.4, 0.4), Detector::falko).remedy.empty());
  OccupancyGrid unknown = rasterize(test::rectangle(4, 3)).value();
  for (std::int8_t& cell : unknown.occupancy_percent)
    if (cell < unknown.occupied_from_percent) cell = OccupancyGrid::kUnknown;
  EXPECT_FALSE(error_of(unknown, Detector::corners).remedy.empty());
  // A grid that is not as large as it says, and one whose cells have no size.
  OccupancyGrid liar = rasterize(test::rectangle(4, 3)).value();
  liar.occupancy_percent.resize(17);
  EXPECT_FALSE(error_of(liar, Detector::corners).remedy.empty());
  for (const double size : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    OccupancyGrid sizeless = rasterize(test::rectangle(4, 3)).value();
    sizeless.resolution_m = size;
    EXPECT_FALSE(error_of(sizeless, Detector::corners).what.empty());
  }
}

TEST(FeatureMap, WithAWrongConfigSaysSo) {
  FeatureMapConfig config;
  config.views.step_m = -1.0;
  EXPECT_NE(to_string(error_of(test::rectangle(4, 3), Detector::falko, config)).find("step_m"),
            std::string::npos);
}

TEST(FeatureMap, OfWallsThatAreNotFiniteIsFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FloorPlan plan = test::rectangle(4.0, 3.0);
  plan.walls.push_back({{nan, 1.0}, {2.0, 1.0}});
  plan.walls.push_back({{1e200, 1e200}, {-1e200, 1.0}});
  for (const Detector detector : {Detector::corners, Detector::falko}) {
    const FeatureMap map = features_of(plan, detector);
    EXPECT_EQ(map.features.size(), 4U);
    for (const PointFeature& feature : map.features) EXPECT_TRUE(feature.point.allFinite());
  }
}

TEST(FeatureMap, FieldsAreWithinTheirRanges) { EXPECT_TRUE(check_config(FeatureMapConfig{})); }

}  // namespace
}  // namespace beaconless
