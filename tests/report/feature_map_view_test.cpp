// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/feature_map_view.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

FloorPlan room() { return {{{{0, 0}, {8, 0}, {8, 5}, {0, 5}, {0, 0}}}}; }

PointFeature feature_at(double x_m, double y_m, double sigma_m = 0.01) {
  return {{x_m, y_m}, sigma_m * sigma_m * Eigen::Matrix2d::Identity(), 0.8, 1.5};
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(FeatureMapView, ShowsEachFeatureOnceInTheColourOfItsShare) {
  const FeatureMap map{.features = {feature_at(0, 0), feature_at(8, 0), feature_at(8, 5), feature_at(4, 2)},
                       .evidence = {{40, 0.9, 0.0}, {40, 0.5, 0.0}, {20, 0.3, 0.01}, {5, 0.1, 0.02}},
                       .places = {}};
  const Picture picture = draw_feature_map(room(), map);
  EXPECT_EQ(count(picture.svg.body(), "marker blue"), 2U);
  EXPECT_EQ(count(picture.svg.body(), "marker green"), 1U);
  EXPECT_EQ(count(picture.svg.body(), "marker orange"), 1U);
  EXPECT_EQ(xml_fault(svg_file(picture)), "");
  EXPECT_THAT(svg_file(picture), HasSubstr("2 features, drawn or found by half"));
  EXPECT_THAT(svg_file(picture), HasSubstr("1 feature, found by fewer"));
}

TEST(FeatureMapView, ShowsCovariancesThatCanBeSeen) {
  const FeatureMap sure{.features = {feature_at(1, 1, 0.001)}, .evidence = {{}}, .places = {}};
  const FeatureMap unsure{.features = {feature_at(1, 1, 0.1)}, .evidence = {{}}, .places = {}};
  EXPECT_EQ(count(draw_feature_map(room(), sure).svg.body(), "<ellipse"), 0U);
  EXPECT_EQ(count(draw_feature_map(room(), unsure).svg.body(), "<ellipse"), 1U);
}

TEST(FeatureMapView, HoldsWithoutAnything) {
  for (const Map& map : {Map(FloorPlan{}), Map(OccupancyGrid{}), Map(room())}) {
    const Picture picture = draw_feature_map(map, {});
    EXPECT_EQ(xml_fault(svg_file(picture)), "");
    EXPECT_THAT(picture.svg.body(), Not(HasSubstr("\"nan")));
  }
}

}  // namespace
}  // namespace beaconless::report
