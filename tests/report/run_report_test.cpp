// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/run_report.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/report/run_figures.hpp"

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

const double kNan = std::nan("");

/// A drive along the middle of a corridor; `lost` says which scans failed.
template <class Lost>
RunReport run_of(std::size_t scans, Lost lost) {
  Rng rng(scans);
  RunReport report;
  report.title = "A drive";
  report.map = std::make_shared<const Map>(FloorPlan{{{{0, 0}, {30, 0}, {30, 4}, {0, 4}, {0, 0}}}});
  report.reference = Trajectory{};
  for (std::size_t i = 0; i < scans; ++i) {
    PoseEstimate estimate;
    estimate.stamp = Stamp{1'400'000'000'000'000'000 + static_cast<std::int64_t>(i) * 25'000'000};
    estimate.map_from_base = {1.0 + 28.0 * static_cast<double>(i) / static_cast<double>(scans),
                              2.0 + rng.normal(0.01), 0.0};
    estimate.status = lost(i) ? Status::lost : Status::ok;
    estimate.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
    estimate.quality = rng.uniform();
    report.estimates.push_back(estimate);
    report.reference->add(estimate.stamp, estimate.map_from_base);
    eval::PoseError error;
    error.stamp = estimate.stamp;
    error.x_m = rng.normal(7e-4);
    error.heading_rad = rng.normal(1e-4);
    report.errors.push_back(error);
    report.bounds.emplace_back(Eigen::Vector3d(2e-7, 2e-7, 1e-8).asDiagonal());
    report.update_times_us.push_back(rng.uniform(1000.0, 3000.0));
  }
  return report;
}

bool never(std::size_t) { return false; }

TEST(RunReport, SaysTheVerdictInWords) {
  RunReport report = run_of(400, never);
  report.error = eval::ErrorTable{};
  report.error->position_m.rmse = 0.0007;
  report.bound_ratio = eval::CrbRatio{1.1, 1.2};
  EXPECT_THAT(html(report),
              HasSubstr("400 of 400 scans localized; position RMSE 0.70 mm against the reference, 1.1 "
                        "times the Cramér–Rao bound."));
}

TEST(RunReport, DoesNotHideTheOneScanThatFailed) {
  const std::string page = html(run_of(20'000, [](std::size_t i) { return i == 777; }));
  EXPECT_THAT(page, HasSubstr("19\u202F999 of 20\u202F000 scans localized, 1 lost."));
  EXPECT_THAT(page, HasSubstr("99.9 %"));
  EXPECT_THAT(page, HasSubstr("verdict mixed"));
}

TEST(RunReport, CallsARunBadThatLostItself) {
  EXPECT_THAT(html(run_of(100, [](std::size_t i) { return i > 60; })), HasSubstr("verdict bad"));
  EXPECT_THAT(html(RunReport{}), HasSubstr("verdict bad"));
}

TEST(RunReport, IsOneSoundFileThatFetchesNothing) {
  RunReport report = run_of(400, never);
  report.title = report.method = report.map_name = report.recording_name = report.command_line =
      report.config_text = "</title><script src=\"http://x\">'&\xFF";
  report.problems.assign(1000, "<img src=x onerror=alert(1)>");
  const std::string page = html(report);
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, Not(HasSubstr("url(")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, HasSubstr("and 800 more"));
}

TEST(RunReport, IsTheSameEachTime) {
  const RunReport report = run_of(300, never);
  EXPECT_EQ(html(report), html(report));
  EXPECT_EQ(draw_run_svg(report), draw_run_svg(report));
}

TEST(RunReport, HoldsForEverythingMissingAndEverythingBroken) {
  EXPECT_EQ(xml_fault(html(RunReport{})), "");
  EXPECT_EQ(xml_fault(draw_run_svg(RunReport{})), "");
  EXPECT_EQ(xml_fault(html(run_of(1, never))), "");
  RunReport report = run_of(50, never);
  for (std::size_t i = 0; i < 50; ++i) {
    report.estimates[i].stamp.ns =
        i % 2 == 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
    report.estimates[i].covariance.setConstant(i % 3 == 0 ? kNan : -1.0);
    report.estimates[i].map_from_base.x_m = kNan;
    report.estimates[i].quality = kNan;
    report.errors[i].x_m = kNan;
    if (i % 2 == 0) report.bounds[i].reset();
    report.update_times_us[i] = i % 2 == 0 ? kNan : -std::numeric_limits<double>::infinity();
  }
  report.error = eval::ErrorTable{};
  report.error->position_m.rmse = kNan;
  report.bound_ratio = eval::CrbRatio{kNan, kNan};
  const std::string page = html(report);
  EXPECT_EQ(xml_fault(page), "");
  for (const char* word : {"\"nan", ">nan", "-nan", "inf\"", ">inf", "NaN"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
}

TEST(RunReport, StaysBelowFiveMegabytesForAHundredThousandScans) {
  const RunReport report = run_of(100'000, [](std::size_t i) { return i % 7 == 0; });
  const std::string page = html(report);
  EXPECT_LT(page.size(), 5'000'000U);
  EXPECT_EQ(xml_fault(page), "");
}

TEST(StatusShades, ShowASingleScan) {
  const RunReport report = run_of(100'000, [](std::size_t i) { return i == 31'415; });
  const RunClock clock(report);
  const auto shades = status_shades(report, clock);
  ASSERT_EQ(shades.size(), 1U);
  EXPECT_EQ(shades[0].name, "lost");
  const double at = clock(report.estimates[31'415].stamp);
  EXPECT_LE(shades[0].from, at);
  EXPECT_GE(shades[0].to, at);
}

TEST(StatusShades, LastUntilTheNextScan) {
  RunReport report = run_of(3, [](std::size_t i) { return i == 1; });
  report.estimates[1].stamp.ns = report.estimates[0].stamp.ns + 1'000'000'000;
  report.estimates[2].stamp.ns = report.estimates[0].stamp.ns + 4'000'000'000;
  const auto shades = status_shades(report, RunClock(report), 400);
  ASSERT_EQ(shades.size(), 1U);
  EXPECT_NEAR(shades[0].from, 1.0, 0.0101);
  EXPECT_NEAR(shades[0].to, 4.0, 0.0101);
}

TEST(Percentile, IsTheNearestRank) {
  const std::vector<double> values{5, 1, kNan, 4, 2, 3};
  EXPECT_EQ(percentile(values, 0.0), 1);
  EXPECT_EQ(percentile(values, 0.5), 3);
  EXPECT_EQ(percentile(values, 1.0), 5);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

}  // namespace
}  // namespace beaconless::report
