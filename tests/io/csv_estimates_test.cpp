// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/estimates_csv.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<PoseEstimate> some_estimates() {
  Rng rng(1);
  std::vector<PoseEstimate> estimates;
  for (int i = 0; i < 100; ++i) {
    PoseEstimate estimate{.stamp = Stamp{1411657682042859001 + i},
                          .map_from_base = {rng.normal(100.0), rng.normal(1e-9), rng.uniform(-3.0, 3.0)},
                          .status = static_cast<Status>(i % 6),
                          .reason = "",
                          .quality = rng.uniform(),
                          .protection_m = rng.uniform(0.0, 5.0),
                          .protection_rad = rng.uniform(0.0, 3.0),
                          .jumped = i % 3 == 0};
    const Eigen::Matrix3d root = Eigen::Matrix3d::NullaryExpr([&] { return rng.normal(0.01); });
    const Eigen::Matrix3d covariance = root * root.transpose();
    estimate.covariance = covariance.selfadjointView<Eigen::Upper>();
    estimates.push_back(estimate);
  }
  return estimates;
}

TEST(EstimatesCsv, WhatIsWrittenReadsBackBitForBit) {
  const TempFolder folder;
  const auto estimates = some_estimates();
  EstimatesCsvWriter writer(folder.path("a.csv"));
  for (const PoseEstimate& estimate : estimates) writer.write(estimate);
  EXPECT_TRUE(writer.good());
  ASSERT_TRUE(writer.finish());
  std::vector<Problem> problems;
  EXPECT_EQ(
      read_estimates_csv(folder.path("a.csv"), [&](const Problem& p) { problems.push_back(p); }).value(),
      estimates);
  EXPECT_THAT(problems, IsEmpty());
}

TEST(EstimatesCsv, IsTheFileThatOthersRelyOn) {
  const TempFolder folder;
  EstimatesCsvWriter writer(folder.path("a.csv"));
  PoseEstimate estimate{
      .stamp = Stamp{1'500'000'000}, .map_from_base = {1.0, -2.5, 0.125}, .status = Status::degraded};
  estimate.covariance << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  estimate.quality = 0.75;
  estimate.protection_m = 0.25;
  estimate.protection_rad = 0.5;
  estimate.jumped = true;
  writer.write(estimate);
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(
      folder.read("a.csv"),
      "t,x_m,y_m,theta_rad,cov_xx_m2,cov_xy_m2,cov_xtheta_mrad,cov_yy_m2,cov_ytheta_mrad,cov_thetatheta_rad2,"
      "status,quality,protection_m,protection_rad,jumped\n"
      "1.500000000,1,-2.5,0.125,1,2,3,4,5,6,degraded,0.75,0.25,0.5,1\n");
}

TEST(EstimatesCsv, FilesFromBeforeProtectionLevelsAreRead) {
  const TempFolder folder;
  const std::string header =
      "t,x_m,y_m,theta_rad,cov_xx_m2,cov_xy_m2,cov_xtheta_mrad,cov_yy_m2,cov_ytheta_mrad,cov_thetatheta_rad2,"
      "status,quality\n";
  const auto read =
      read_estimates_csv(folder.write("a.csv", header + "1,1,2,3,1,0,0,1,0,1,ok,0.5\n"
                                                        "2,1,2,3,1,0,0,1,0,1,ok,0.5,0.1,0.1,1\n"));
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->size(), 1U) << "a row has as many values as its header";
  EXPECT_EQ(read->front().quality, 0.5);
  EXPECT_EQ(read->front().protection_m, PoseEstimate::kUnbounded_m);
  EXPECT_FALSE(read->front().jumped);
}

TEST(EstimatesCsv, BadRowsAreToldByNumberAndPassedOver) {
  const TempFolder folder;
  const std::string header(kEstimatesCsvHeader);
  std::vector<Problem> problems;
  const auto read = read_estimates_csv(folder.write("a.csv", header + "\n1,1,2,3,1,0,0,1,0,1,ok,0.5,1,1,0\r\n"
                                                                      "2,1,2,3,1,0,0,1,0,1,fine,0.5,1,1,0\n"
                                                                      "3,1,nan,3,1,0,0,1,0,1,ok,0.5,1,1,0\n"
                                                                      "4,1,2,3,1,0,0,1,0,1,ok\n"
                                                                      "x,1,2,3,1,0,0,1,0,1,ok,0.5,1,1,0\n"
                                                                      "6,1,2,3,1,0,0,1,0,1,lost,0,1,1,0\n"),
                                       [&](const Problem& p) { problems.push_back(p); });
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 2U);
  EXPECT_TRUE((*read)[0].ok());
  EXPECT_EQ((*read)[1].status, Status::lost);
  ASSERT_EQ(problems.size(), 4U);
  for (std::size_t i = 0; i < problems.size(); ++i)
    EXPECT_EQ(problems[i].where, folder.path("a.csv") + ":" + std::to_string(i + 3));
  EXPECT_THAT(problems[0].what, HasSubstr("\"fine\""));
}

TEST(EstimatesCsv, RefusesOtherFiles) {
  const TempFolder folder;
  EXPECT_THAT(read_estimates_csv(folder.write("a.csv", "")).error().what, HasSubstr("empty"));
  EXPECT_THAT(read_estimates_csv(folder.write("a.csv", "t,x,y\n1,2,3\n")).error().remedy, HasSubstr("t,x_m"));
  EXPECT_THAT(read_estimates_csv(folder.path("gone.csv")).error().what, HasSubstr("no such file"));
  EXPECT_TRUE(read_estimates_csv(folder.write("a.csv", std::string(kEstimatesCsvHeader))).value().empty());
  EstimatesCsvWriter lost(folder.path("gone/a.csv"));
  EXPECT_FALSE(lost.finish());
}

}  // namespace
}  // namespace beaconless::io
