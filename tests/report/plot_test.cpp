// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/plot.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::nan("");

void expect_sound(const Picture& picture) {
  const std::string body = picture.svg.body();
  EXPECT_EQ(xml_fault(svg_file(picture)), "");
  EXPECT_THAT(body, Not(HasSubstr("nan")));
  EXPECT_THAT(body, Not(HasSubstr("inf")));
}

Plot plot_of(std::vector<double> x, std::vector<double> y) {
  Plot plot;
  plot.x_title = "time [s]";
  plot.y_title = "error [m]";
  plot.series.push_back({"a", Colour::blue, Mark::line, std::move(x), std::move(y)});
  return plot;
}

TEST(Plot, HoldsWhateverTheValuesAre) {
  const std::vector<std::vector<double>> all{
      {},       {1.0},        {0.0},    {kNan}, {kInf, -kInf}, {kNan, 1.0, kNan}, {1e300, -1e300},
      {1e-320}, {-1.0, -2.0}, {5, 5, 5}};
  for (const auto& x : all)
    for (const auto& y : all)
      for (const bool log_y : {false, true})
        for (const Mark mark : {Mark::line, Mark::dots}) {
          Plot plot = plot_of(x, y);
          plot.log_y = log_y;
          plot.series[0].mark = mark;
          plot.level = Level{y.empty() ? kNan : y[0], "level"};
          plot.shades = {{kNan, 1.0, "shade", Colour::red}, {0.5, -kInf, "shade", Colour::red}};
          expect_sound(draw_plot(plot));
        }
}

TEST(Plot, SaysWhenThereIsNothing) {
  EXPECT_THAT(draw_plot({}).svg.body(), HasSubstr("no values"));
  EXPECT_THAT(draw_plot(plot_of({1.0}, {kNan})).svg.body(), HasSubstr("no values"));
  EXPECT_THAT(draw_plot(plot_of({1.0}, {2.0})).svg.body(), Not(HasSubstr("no values")));
}

TEST(Plot, EscapesHostileNames) {
  Plot plot = plot_of({0, 1}, {1, 2});
  plot.x_title = plot.y_title = plot.series[0].name = "</svg><script>\"'&\xFF";
  const std::string file = svg_file(draw_plot(plot));
  EXPECT_THAT(file, Not(HasSubstr("<script>")));
  EXPECT_EQ(xml_fault(file), "");
}

TEST(Plot, StaysSmallForManyValuesAndKeepsTheSpike) {
  Rng rng(1);
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 200'000; ++i) {
    x.push_back(i);
    y.push_back(rng.normal());
  }
  y[123'456] = 987.0;
  const Picture picture = draw_plot(plot_of(x, y));
  // At most four points a column of pixels, each about ten bytes of path, plus axes.
  EXPECT_LT(picture.svg.body().size(), 4U * 680U * 12U + 5000U);
  EXPECT_THAT(picture.svg.body(), HasSubstr(">1000<"));  // the axis reaches to the spike
  expect_sound(picture);
}

TEST(Plot, DoesNotDependOnTheOrderOfItsPoints) {
  EXPECT_EQ(draw_plot(plot_of({1, 2, 3, 4}, {5, 7, 6, 9})).svg.body(),
            draw_plot(plot_of({4, 2, 3, 1}, {9, 7, 6, 5})).svg.body());
}

TEST(Plot, NamesEachThingOnceInTheLegend) {
  Plot plot = plot_of({0, 1}, {1, 2});
  plot.shades = {{0, 1, "lost", Colour::red}, {2, 3, "lost", Colour::red}};
  plot.level = Level{1.5, "limit"};
  EXPECT_EQ(draw_plot(plot).legend.size(), 3U);
}

TEST(Histogram, HoldsWhateverTheValuesAre) {
  for (const auto& values : std::vector<std::vector<double>>{{},
                                                             {3.0},
                                                             {kNan, kInf},
                                                             {0, 0, 0},
                                                             {-5, 5},
                                                             {1e300, 1},
                                                             {1e-320, 2e-320},
                                                             std::vector<double>(1000, 7.0)})
    expect_sound(
        draw_histogram(values, "t [ms]", "scans", std::vector<Level>{{kNan, "p99"}, {3.0, "median"}}));
}

TEST(Histogram, CountsWhatLiesFarBeyond) {
  std::vector<double> values(1000, 1.0);
  values[3] = 500.0;
  EXPECT_THAT(draw_histogram(values, "t [ms]", "scans").note, HasSubstr("1 of 1000 scans lie beyond"));
  values[3] = 1.2;
  EXPECT_EQ(draw_histogram(values, "t [ms]", "scans").note, "");
}

}  // namespace
}  // namespace beaconless::report
