// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_marks.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/report/map_view.hpp"

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

const FloorPlan kRoom{{{{0, 0}, {8, 0}, {8, 5}, {0, 5}, {0, 0}}}};

std::string file_with(const MapMarks& marks, const MapViewConfig& config = {}) {
  return svg_file(draw_map(kRoom, {}, {}, {}, std::span(&marks, 1), config));
}

TEST(MapMarks, EachKindIsDrawnAndNamed) {
  for (const Mark mark : {Mark::ring, Mark::square, Mark::dots, Mark::outline}) {
    const std::string file = file_with({"people & <others>", {{2, 2}, {3, 3}}, Colour::red, mark, 0.2});
    EXPECT_EQ(xml_fault(file), "");
    EXPECT_THAT(file, HasSubstr("people &amp; &lt;others&gt;"));
    EXPECT_GT(file.size(), file_with({}).size());
  }
}

TEST(MapMarks, WithoutAnyPointNothingIsSaid) {
  EXPECT_THAT(file_with({"nobody", {}, Colour::red}), Not(HasSubstr("nobody")));
  const std::string file = file_with({"nowhere", {{std::nan(""), 1}}, Colour::red});
  EXPECT_THAT(file, Not(HasSubstr("nowhere")));
  EXPECT_THAT(file, Not(HasSubstr("nan")));
}

TEST(MapMarks, ADiscHasTheMapsScale) {
  // Twice as near, twice as large.
  const auto radius = [](double half_m) {
    MapViewConfig config;
    config.window =
        Eigen::AlignedBox2d(Eigen::Vector2d(4 - half_m, 2 - half_m), Eigen::Vector2d(4 + half_m, 2 + half_m));
    const MapMarks marks{"person", {{4, 2}}, Colour::orange, Mark::outline, 0.25};
    const std::string body = draw_map(kRoom, {}, {}, {}, std::span(&marks, 1), config).svg.body();
    const auto at = body.rfind(" r=\"");
    return std::stod(body.substr(at + 4));
  };
  EXPECT_NEAR(radius(1.0) / radius(2.0), 2.0, 0.05);
}

TEST(MapMarks, WithoutMarksTheMapIsAsItWas) {
  EXPECT_EQ(svg_file(draw_map(kRoom, {})), svg_file(draw_map(kRoom, {}, {}, {}, {}, MapViewConfig{})));
}

}  // namespace
}  // namespace beaconless::report
