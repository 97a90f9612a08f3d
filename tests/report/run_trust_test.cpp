// SPDX-License-Identifier: Apache-2.0
// What a page tells of a robot that did not know where it was, and of how far it can be believed.
#include <gmock/gmock.h>

#include "beaconless/report/run_figures.hpp"
#include "beaconless/report/run_report.hpp"

#include "well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A drive along a corridor: 20 scans of search, then found; 5 lost on the way.
RunReport found_run() {
  RunReport report;
  report.map = std::make_shared<const Map>(FloorPlan{{{{0, 0}, {30, 0}, {30, 4}, {0, 4}, {0, 0}}}});
  for (int i = 0; i < 200; ++i) {
    PoseEstimate estimate;
    estimate.stamp = Stamp{1'400'000'000'000'000'000 + std::int64_t{i} * 25'000'000};
    estimate.map_from_base = {1.0 + 0.1 * i, 2.0, 0.0};
    estimate.status = i < 20 ? Status::relocalizing : i >= 100 && i < 120 ? Status::lost : Status::ok;
    estimate.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
    estimate.quality = i < 20 ? 0.2 : 0.9;
    report.estimates.push_back(estimate);
  }
  report.places.push_back({0,
                           report.estimates.front().stamp,
                           {{{1.0, 2.0, 0.0}, 0.97, 0.62}, {{29.0, 2.0, kPi}, 0.96, 0.38}},
                           2});
  return report;
}

TEST(RunTrust, PlacesThatFittedAreDrawnNumberedAndListed) {
  const RunReport report = found_run();
  const std::string page = html(report);
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("2 places fit at 0 s"));
  EXPECT_THAT(page, HasSubstr("1: 62 %"));
  EXPECT_THAT(page, HasSubstr("2: 38 %"));
  EXPECT_THAT(page, HasSubstr("Places that fitted"));
  EXPECT_THAT(page, HasSubstr("0.97"));
  EXPECT_THAT(page, HasSubstr("estimate, relocalizing"));
  RunReport known = report;
  known.places.clear();
  EXPECT_THAT(html(known), Not(HasSubstr("place")));
}

TEST(RunTrust, LostScansMakeARunBadAndThoseOfASearchDoNot) {
  // A tenth is lost.
  EXPECT_THAT(html(found_run()), HasSubstr("verdict bad"));
  RunReport searched = found_run();
  for (PoseEstimate& estimate : searched.estimates)
    if (estimate.status == Status::lost) estimate.status = Status::ok;
  EXPECT_THAT(html(searched), HasSubstr("verdict mixed"));
}

TEST(RunTrust, ProtectionIsDrawnWhereSomethingBoundsTheError) {
  RunReport report = found_run();
  EXPECT_THAT(html(report), Not(HasSubstr("protection level")));
  for (PoseEstimate& estimate : report.estimates) {
    estimate.protection_m = 0.05;
    estimate.protection_rad = 0.01;
  }
  EXPECT_THAT(html(report), HasSubstr("protection level"));
  eval::JudgedEstimate judged{.stamp = report.estimates[50].stamp, .quality = 0.9};
  judged.protection_m = 0.05;
  judged.protection_rad = 0.01;
  judged.position_error_m = 0.04;
  report.judged.assign(10, judged);
  report.judged.back().position_error_m = 0.06;
  const std::string page = html(report);
  EXPECT_EQ(xml_fault(page), "");
  EXPECT_THAT(page, HasSubstr("1 of 10 poses are further off than their protection level says"));
  EXPECT_THAT(page, HasSubstr("Poses of each tenth: 10."));
}

TEST(RunTrust, BeamsAgainstTheMapAreMarked) {
  RunReport report = found_run();
  RawScan raw;
  raw.angle_min_rad = -0.05F;
  raw.angle_increment_rad = 0.01F;
  raw.range_max_m = 60.0F;
  raw.ranges_m = {5.0F, 5.0F, 5.0F, 35.0F, 35.0F};
  report.good_scans.push_back({Scan::make(raw).value(), {2.0, 2.0, 0.0}});
  const auto marks = marks_of(report);
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_EQ(marks[0].points.size(), 3U);
  EXPECT_EQ(marks[0].colour, Colour::orange);
  EXPECT_EQ(marks[1].points.size(), 2U);
  EXPECT_EQ(marks[1].colour, Colour::red);
}

}  // namespace
}  // namespace beaconless::report
