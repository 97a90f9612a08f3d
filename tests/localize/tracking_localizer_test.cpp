// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/eval/nees.hpp"
#include "beaconless/io/scenario_io.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

sim::Scenario scenario(const std::string& name) {
  return io::read_scenario(std::string(BEACONLESS_SOURCE_DIR) + "/data/scenarios/" + name + ".yaml").value();
}

std::unique_ptr<Localizer> localizer_for(const sim::Scenario& s) {
  return make_localizer({.base_from_laser = s.base_from_laser}, s.plan).value();
}

std::vector<PoseEstimate> run(const sim::Scenario& s, const sim::SimulatedRun& drive) {
  const auto localizer = localizer_for(s);
  localizer->start_at(drive.truth.front().pose);
  std::vector<PoseEstimate> estimates;
  for (const Event& event : drive.events) estimates.push_back(localizer->update(event));
  return estimates;
}

class EachRoom : public testing::TestWithParam<const char*> {};

TEST_P(EachRoom, EveryScanIsOkAndItsCovarianceHonest) {
  sim::Scenario s = scenario(GetParam());
  double nees = 0.0;
  double scans = 0.0;
  for (int draw = 0; draw < 5; ++draw, ++s.seed) {
    const auto drive = sim::simulate(s).value();
    const auto estimates = run(s, drive);
    for (const PoseEstimate& estimate : estimates) {
      ASSERT_EQ(estimate.status, Status::ok) << estimate.reason;
      ASSERT_EQ(estimate.reason, "");
    }
    const eval::Consistency consistency = eval::consistency_of(estimates, drive.truth);
    nees += static_cast<double>(estimates.size()) * consistency.mean_nees;
    scans += static_cast<double>(estimates.size());
  }
  EXPECT_NEAR(nees / scans, 3.0, 2.58 * std::sqrt(6.0 / scans));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EachRoom,
                         testing::Values("small-static", "small-rotation", "room-ellipse-people"),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

TEST(TrackingLocalizer, GivesTheSameBitsTwice) {
  const sim::Scenario s = scenario("small-drive");
  const auto drive = sim::simulate(s).value();
  EXPECT_EQ(run(s, drive), run(s, drive));
}

TEST(TrackingLocalizer, SaysWhatItIsMissing) {
  const sim::Scenario s = scenario("small-static");
  const auto drive = sim::simulate(s).value();
  const auto localizer = localizer_for(s);
  EXPECT_EQ(localizer->update(drive.events.front()).status, Status::not_started);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  localizer->start_at({nan, 0, 0});
  EXPECT_EQ(localizer->update(drive.events.front()).status, Status::not_started);
  localizer->start_at(drive.truth.front().pose);
  EXPECT_EQ(localizer->update(Odometry{}).status, Status::not_a_scan);
  EXPECT_EQ(localizer->update(drive.events.front()).status, Status::ok);
}

TEST(TrackingLocalizer, IsTotalOnAnyScanAtAnyTime) {
  Rng rng(8);
  const auto localizer = make_localizer({}, test::niche_room()).value();
  localizer->start_at({3, 2, 0});
  int judged = 0;
  for (int i = 0; i < 300; ++i) {
    RawScan raw{.stamp = {static_cast<std::int64_t>(rng.bits() >> 1U)},
                .angle_min_rad = static_cast<float>(rng.uniform(-4, 4)),
                .angle_increment_rad = static_cast<float>(rng.uniform(-0.1, 0.1)),
                .range_max_m = 30.0F};
    const auto count = static_cast<std::size_t>(rng.uniform(1, 2000));
    for (std::size_t k = 0; k < count; ++k)
      raw.ranges_m.push_back(rng.uniform() < 0.2 ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(rng.uniform(-1, 40)));
    const auto scan = Scan::make(raw);
    if (!scan) continue;
    const PoseEstimate estimate = localizer->update(*scan);
    ASSERT_TRUE(estimate.map_from_base.is_finite());
    ASSERT_TRUE(estimate.covariance.allFinite());
    ASSERT_EQ(estimate.covariance, estimate.covariance.transpose());
    ASSERT_TRUE(estimate.quality >= 0.0 && estimate.quality <= 1.0);
    judged += estimate.ok() ? 1 : 0;
  }
  EXPECT_LT(judged, 30) << "noise must not be taken for a good fit";
}

/// Carried to another room, the robot must say so; brought back, it must go on.
TEST(TrackingLocalizer, SaysThatItIsLostAndComesBackWhenTheRoomDoes) {
  Rng rng(9);
  const FloorPlan home = test::niche_room();
  const RayCaster home_walls(home.segments());
  const RayCaster elsewhere(FloorPlan{{{{-9, -1}, {9, -3}, {2, 12}, {-9, -1}}}}.segments());
  const auto localizer = make_localizer({}, home).value();
  const Pose2 truth{3, 2, 0.3};
  localizer->start_at(truth);
  std::int64_t tick = 0;
  const auto see = [&](const RayCaster& walls) {
    return localizer->update(Scan::make(test::sweep(walls, truth, 0.01, rng, {25'000'000 * tick++})).value());
  };
  for (int i = 0; i < 20; ++i) ASSERT_EQ(see(home_walls).status, Status::ok);
  Status last = Status::ok;
  for (int i = 0; i < 20; ++i) {
    const PoseEstimate estimate = see(elsewhere);
    EXPECT_NE(estimate.status, Status::ok)
        << "scan " << i << " of the other room, quality " << estimate.quality;
    last = estimate.status;
  }
  EXPECT_EQ(last, Status::lost);
  // It looks around twice a second, and five scans must agree.
  PoseEstimate estimate;
  for (int i = 0; i < 40; ++i) estimate = see(home_walls);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, truth), 0.005);
}

TEST(TrackingLocalizer, InACorridorIsDegradedAndLessSureWithEveryScan) {
  Rng rng(10);
  const FloorPlan corridor{{{{-100, 0}, {100, 0}}, {{-100, 2.5}, {100, 2.5}}}};
  const RayCaster walls(corridor.segments());
  const auto localizer = make_localizer({}, corridor).value();
  localizer->start_at({0, 1, 0});
  double before = 0.0;
  for (int i = 0; i < 10; ++i) {
    const PoseEstimate estimate =
        localizer->update(Scan::make(test::sweep(walls, {0, 1, 0}, 0.01, rng, {25'000'000L * i})).value());
    ASSERT_EQ(estimate.status, Status::degraded);
    ASSERT_GE(estimate.covariance(0, 0), before);
    before = estimate.covariance(0, 0);
  }
  EXPECT_GT(before, 0.2 * 0.2) << "a start pose is known to a quarter of a metre, and nothing has told more";
}

TEST(TrackingLocalizer, ACoveredScannerIsNeverOk) {
  Rng rng(12);
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const auto localizer = make_localizer({}, plan).value();
  const Pose2 truth{3, 2, 0.3};
  localizer->start_at(truth);
  std::int64_t tick = 0;
  const auto see = [&](bool covered) {
    RawScan raw = test::sweep(walls, truth, 0.01, rng, {25'000'000 * tick++});
    if (covered) std::fill(raw.ranges_m.begin(), raw.ranges_m.end(), 0.3F);
    return localizer->update(Scan::make(raw).value());
  };
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(see(false).ok());
  double before = 0.0;
  for (int i = 0; i < 40; ++i) {
    const PoseEstimate estimate = see(true);
    ASSERT_FALSE(estimate.ok()) << i;
    ASSERT_GE(estimate.covariance(0, 0), before);
    before = estimate.covariance(0, 0);
  }
  PoseEstimate estimate;
  for (int i = 0; i < 30; ++i) estimate = see(false);
  EXPECT_TRUE(estimate.ok()) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, truth), 0.005);
}

TEST(TrackingLocalizer, AStartInTheWrongPlaceIsNotBelievedAndTheRightOneFound) {
  Rng rng(13);
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const auto localizer = make_localizer({}, plan).value();
  const Pose2 truth{3, 2, 0.3};
  localizer->start_at({100, 100, 0});
  for (int i = 0; i < 20; ++i) {
    const PoseEstimate estimate =
        localizer->update(Scan::make(test::sweep(walls, truth, 0.01, rng, {25'000'000L * i})).value());
    ASSERT_FALSE(estimate.ok() && i < 5) << i;  // so many scans have to agree
    ASSERT_TRUE(estimate.ok() || i < 12) << i << ": " << estimate.reason;
    if (estimate.ok()) {
      ASSERT_LT(distance_m(estimate.map_from_base, truth), 0.005);
    } else {
      ASSERT_GT(estimate.covariance(0, 0), 0.2 * 0.2) << i;
    }
  }
}

TEST(MakeLocalizer, RefusesWhatCannotWork) {
  EXPECT_EQ(make_localizer({.method = "icp-ful"}, test::niche_room()).error().remedy,
            "did you mean \"icp-full\"?");
  EXPECT_EQ(make_localizer({.icp = {.sigma_m = -1.0}}, test::niche_room()).error().where, "icp.sigma_m");
  EXPECT_EQ(make_localizer({}, FloorPlan{}).error().where, "map");
  EXPECT_EQ(make_localizer({}, OccupancyGrid{}).error().where, "map");
}

}  // namespace
}  // namespace beaconless
