// SPDX-License-Identifier: Apache-2.0
// Two lasers on one robot.
#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/localize/multi_laser_localizer.hpp"
#include "beaconless/sim/scenario.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

const LaserOnRobot kFront{"front", {0.6, 0.2, 0.0}};
const LaserOnRobot kRear{"rear", {-0.5, -0.2, kPi}};

/// What happens to a robot with both lasers, each looking half around.
struct BothDrive {
  std::vector<Event> events;
  std::map<Stamp, Pose2> truth;  // of the base, at each stamp
};

/// Around the middle of a room, by two simulations of one path; the rear laser sees what it wants, and its
/// sweeps lie between those of the other or not.
BothDrive around(const FloorPlan& rear_sees = test::niche_room(), bool is_between = false) {
  BothDrive drive;
  for (const LaserOnRobot& laser : {kFront, kRear}) {
    const bool is_front = laser.frame_id == "front";
    sim::Scenario scenario;
    scenario.plan = is_front ? test::niche_room() : rear_sees;
    scenario.path = sim::Ellipse{.center_x_m = 3.4,
                                 .center_y_m = 2.0,
                                 .semi_axis_x_m = 1.0,
                                 .semi_axis_y_m = 0.8,
                                 .turns = 3.0,
                                 .speed_mps = 0.8};
    scenario.duration_s = 20.0;
    scenario.base_from_laser = laser.base_from_laser;
    scenario.seed = is_front ? 3 : 4;
    scenario.lidar.beam_count = 361;
    scenario.lidar.angle_min_deg = -90.0;
    scenario.lidar.angle_max_deg = 90.0;
    scenario.lidar.rate_hz = 20.0;
    scenario.lidar.sweep = sim::Sweep::instantaneous;
    int sweep = 0;
    const auto done = sim::simulate(scenario, [&](const sim::Sample& sample) {
      if (sweep++ % 2 != (!is_front && is_between ? 1 : 0)) return;  // 10 Hz each
      RawScan raw = sample.scan;
      raw.frame_id = laser.frame_id;
      drive.truth[raw.stamp] = sample.map_from_base;
      drive.events.emplace_back(Scan::make(std::move(raw)).value());
    });
    EXPECT_TRUE(done);
  }
  std::stable_sort(drive.events.begin(), drive.events.end(),
                   [](const Event& a, const Event& b) { return stamp_of(a) < stamp_of(b); });
  return drive;
}

/// What a localizer of these lasers makes of the scans that are theirs.
struct Told {
  PoseEstimate estimate;
  Pose2 truth;
  std::string frame_id;
};

std::vector<Told> follow(const std::vector<LaserOnRobot>& lasers, const BothDrive& drive) {
  const auto localizer = make_localizer({.lasers = lasers}, test::niche_room()).value();
  localizer->start_at(drive.truth.begin()->second);
  std::vector<Told> told;
  for (const Event& event : drive.events) {
    const auto* scan = std::get_if<Scan>(&event);
    const std::string frame = scan != nullptr ? scan->frame_id() : "";
    const PoseEstimate estimate = localizer->update(event);
    if (std::holds_alternative<Scan>(event) && estimate.status != Status::not_a_scan)
      told.push_back({estimate, drive.truth.at(stamp_of(event)), frame});
  }
  return told;
}

double rmse_m(const std::vector<Told>& told, const std::string& frame = "rear") {
  double sum = 0.0;
  int count = 0;
  for (const Told& one : told) {
    if (one.frame_id != frame) continue;
    sum += std::pow(distance_m(one.estimate.map_from_base, one.truth), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

/// At one moment both tell twice as much as one; the second of two scans of a moment has heard both.
TEST(MultiLaser, BothAreNearerThanEither) {
  const BothDrive drive = around();
  const auto front = follow({kFront}, drive);
  const auto rear = follow({kRear}, drive);
  const auto both = follow({kFront, kRear}, drive);
  ASSERT_EQ(both.size(), front.size() + rear.size());
  EXPECT_LT(rmse_m(both), 0.85 * std::min(rmse_m(front, "front"), rmse_m(rear)));
  for (const Told& one : both) EXPECT_TRUE(one.estimate.ok()) << one.estimate.reason;
}

TEST(MultiLaser, SweepsBetweenThoseOfTheOtherHelpToo) {
  const BothDrive drive = around(test::niche_room(), true);
  const auto both = follow({kFront, kRear}, drive);
  EXPECT_LT(rmse_m(both), 1.02 * rmse_m(follow({kRear}, drive)));
  EXPECT_LT(rmse_m(both, "front"), 1.02 * rmse_m(follow({kFront}, drive), "front"));
}

TEST(MultiLaser, CovarianceOfBothIsHonest) {
  const auto both = follow({kFront, kRear}, around());
  double nees = 0.0;
  int count = 0;
  for (const Told& one : both) {
    if (one.frame_id != "rear") continue;
    const Eigen::Vector3d off = way_between(one.estimate.map_from_base, one.truth);
    nees += off.dot(one.estimate.covariance.inverse() * off);
    ++count;
  }
  EXPECT_NEAR(nees / count, 3.0, 0.7);  // 200 scans: 3 by 0.17, four of them
}

/// A laser near the floor sees pallets that no map holds.
TEST(MultiLaser, OneThatSeesWhatIsNotOnTheMapTakesNothingFromTheOther) {
  const BothDrive drive = around(test::rectangle(7.0, 4.4));
  const auto both = follow({kFront, kRear}, drive);
  const auto front = follow({kFront}, drive);
  EXPECT_LT(rmse_m(both, "front"), 1.2 * rmse_m(front, "front"));
  EXPECT_LT(rmse_m(both), 0.05);
}

/// Wheels at 50 Hz, which somebody sets anew in the middle.
BothDrive with_wheels(BothDrive drive, double set_off_by_m) {
  std::vector<Event> wheels;
  const Pose2 start = drive.truth.begin()->second;
  for (const auto& [stamp, pose] : drive.truth) {
    Pose2 odom_from_base = start.inverse() * pose;
    if (seconds_between(drive.truth.begin()->first, stamp) > 8.0) odom_from_base.x_m += set_off_by_m;
    wheels.emplace_back(Odometry{stamp, odom_from_base, {}, "odom"});
  }
  drive.events.insert(drive.events.begin(), wheels.begin(), wheels.end());
  std::stable_sort(drive.events.begin(), drive.events.end(),
                   [](const Event& a, const Event& b) { return stamp_of(a) < stamp_of(b); });
  return drive;
}

TEST(MultiLaser, WheelsThatJumpDoNotCarryThemOff) {
  for (const double off_m : {5.0, 0.5, 0.2})
    for (const Told& one : follow({kFront, kRear}, with_wheels(around(test::niche_room(), true), off_m))) {
      const double error_m = distance_m(one.estimate.map_from_base, one.truth);
      EXPECT_TRUE(!one.estimate.is_trusted() || error_m < one.estimate.protection_m)
          << "set off by " << off_m << " m: " << error_m << " m";
    }
}

TEST(MultiLaser, AreFoundAnywhere) {
  const BothDrive drive = around();
  const auto localizer = make_localizer({.lasers = {kFront, kRear}}, test::niche_room()).value();
  localizer->start_anywhere();
  PoseEstimate last;
  for (const Event& event : drive.events) last = localizer->update(event);
  EXPECT_TRUE(last.ok()) << last.reason;
  EXPECT_LT(distance_m(last.map_from_base, drive.truth.rbegin()->second), 0.02);
  ASSERT_EQ(localizer->lasers().size(), 2U);
  EXPECT_EQ(localizer->lasers()[1].frame_id, "rear");
  EXPECT_TRUE(localizer->lasers()[1].estimate.ok());
}

TEST(MultiLaser, LasersOfOneFrameAreRefused) {
  const auto made = make_localizer({.lasers = {kFront, kFront}}, test::niche_room());
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().what.find("\"front\""), std::string::npos);
}

/// A localizer that says what it is told to say.
class Parrot : public Localizer {
 public:
  void start_at(const Pose2& pose) override { started.push_back(pose); }
  void start_anywhere(const std::optional<SearchRegion>& /*within*/) override {}
  std::span<const PoseCandidate> candidates() const override { return {}; }
  PoseEstimate update(const Event& event) override {
    ++updates;
    says.stamp = stamp_of(event);
    return says;
  }

  PoseEstimate says;
  std::vector<Pose2> started;
  int updates = 0;
};

PoseEstimate sure_of(const Pose2& pose) {
  PoseEstimate estimate;
  estimate.map_from_base = pose;
  estimate.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  estimate.status = Status::ok;
  estimate.reason = "";
  estimate.quality = 0.9;
  estimate.protection_m = 0.1;
  estimate.protection_rad = 0.1;
  return estimate;
}

class TwoParrots : public testing::Test {
 protected:
  static constexpr std::int64_t kStep_ns = 50'000'000;

  PoseEstimate hear(const std::string& frame_id) {
    now_.ns += kStep_ns;
    return both_.update(Scan::make({.stamp = now_,
                                    .frame_id = frame_id,
                                    .angle_increment_rad = 0.1F,
                                    .range_max_m = 10.0F,
                                    .ranges_m = std::vector<float>(8, 1.0F)})
                            .value());
  }

  Parrot* front_ = new Parrot;  // belong to both_
  Parrot* rear_ = new Parrot;

 private:
  static std::vector<MultiLaserLocalizer::Laser> lasers_of(Parrot* front, Parrot* rear) {
    std::vector<MultiLaserLocalizer::Laser> lasers;
    lasers.push_back({"front", std::unique_ptr<Localizer>(front)});
    lasers.push_back({"rear", std::unique_ptr<Localizer>(rear)});
    return lasers;
  }

  Stamp now_;

 protected:
  MultiLaserLocalizer both_{LocalizerConfig{}, lasers_of(front_, rear_)};
};

TEST_F(TwoParrots, SureOfDifferentPlacesAreToldAsSuch) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({3.0, 1.0, 0.0});
  EXPECT_TRUE(hear("front").ok());
  const PoseEstimate told = hear("rear");
  EXPECT_EQ(told.status, Status::degraded);
  EXPECT_EQ(told.quality, 0.0);
  EXPECT_EQ(told.protection_m, PoseEstimate::kUnbounded_m);
  EXPECT_NE(told.reason.find("different places"), std::string_view::npos);
}

TEST_F(TwoParrots, SureOfDifferentPlacesDoNotTakeTurns) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({3.0, 1.0, 0.0});
  for (int i = 0; i < 20; ++i) {
    EXPECT_NEAR(hear("front").map_from_base.x_m, 1.0, 1e-9);
    EXPECT_NEAR(hear("rear").map_from_base.x_m, 1.0, 1e-9);
  }
}

TEST_F(TwoParrots, ALeadThatGoesToAnotherPlaceIsAJump) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({3.0, 1.0, 0.0});
  hear("front"), hear("rear");
  front_->says.status = Status::lost;
  hear("front");
  const PoseEstimate told = hear("rear");
  EXPECT_NEAR(told.map_from_base.x_m, 3.0, 1e-9);
  EXPECT_FALSE(told.is_trusted());
}

/// Not degraded: what the trusted one sees fits. But trust needs both.
TEST_F(TwoParrots, OneThatDeservesLessTrustTakesTheTrustAway) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({3.0, 1.0, 0.0});
  rear_->says.quality = 0.1;
  hear("front");
  const PoseEstimate told = hear("rear");
  EXPECT_TRUE(told.ok());
  EXPECT_FALSE(told.is_trusted());
  EXPECT_EQ(told.protection_m, PoseEstimate::kUnbounded_m);
  EXPECT_NEAR(told.map_from_base.x_m, 1.0, 1e-9);
}

/// A robot in one of two rooms that are alike to one of them.
TEST_F(TwoParrots, ALostOneTakesTheTrustAway) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says.status = Status::lost;
  hear("rear");
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(hear(i % 2 == 0 ? "front" : "rear").is_trusted());
}

/// One whose clock is wrong is off by what was driven meanwhile, with every scan.
TEST_F(TwoParrots, OneThatIsOffAgainAndAgainIsNotFused) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({1.15, 1.0, 0.0});
  PoseEstimate told;
  for (int i = 0; i < 50; ++i) hear("front"), told = hear("rear");
  EXPECT_TRUE(told.ok());
  EXPECT_FALSE(told.is_trusted());
  EXPECT_NEAR(told.map_from_base.x_m, 1.0, 1e-9);
}

TEST_F(TwoParrots, AWordHoldsForHalfASecond) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({1.01, 1.0, 0.0});
  hear("front");
  for (int i = 0; i < 12; ++i) hear("rear");
  EXPECT_NEAR(hear("rear").map_from_base.x_m, 1.01, 1e-9);
}

/// In a corridor one sees along, and the other across.
TEST_F(TwoParrots, HelpEachOtherWhereOneSeesNothing) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({1.5, 1.004, 0.0});
  rear_->says.status = Status::degraded;
  rear_->says.covariance(0, 0) = 1e6;
  hear("front");
  const PoseEstimate told = hear("rear");
  EXPECT_TRUE(told.ok());
  EXPECT_NEAR(told.map_from_base.x_m, 1.0, 1e-3);
  EXPECT_GT(told.map_from_base.y_m, 1.001);
  EXPECT_LT(told.covariance(1, 1), 1e-4);
}

TEST_F(TwoParrots, ALevelBoundsTheFusedPoseToo) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says = sure_of({1.02, 1.0, 0.0});
  rear_->says.protection_m = 0.05;
  hear("front");
  const PoseEstimate told = hear("rear");
  const double off_m = std::abs(told.map_from_base.x_m - 1.02);
  EXPECT_GT(off_m, 1e-4);
  EXPECT_NEAR(told.protection_m, 0.05 + off_m, 1e-9);
}

/// It may see what is not on the map: then it is asked less and less often.
TEST_F(TwoParrots, ALostOneIsSetRightLessAndLessOften) {
  front_->says = sure_of({1.0, 1.0, 0.0});
  rear_->says.status = Status::lost;
  for (int i = 0; i < 200; ++i) {
    EXPECT_TRUE(hear("front").ok());
    const PoseEstimate told = hear("rear");
    EXPECT_TRUE(told.ok()) << told.reason;
    EXPECT_NEAR(told.map_from_base.x_m, 1.0, 1e-6);
  }
  ASSERT_GE(rear_->started.size(), 3U);
  EXPECT_NEAR(rear_->started.back().x_m, 1.0, 1e-6);
  EXPECT_LT(rear_->started.size(), 12U);
  EXPECT_EQ(rear_->updates, 200);  // it looks by itself in between
}

TEST_F(TwoParrots, AreLostWhereBothAre) {
  front_->says.status = rear_->says.status = Status::lost;
  front_->says.reason = rear_->says.reason = "nothing fits";
  hear("front");
  EXPECT_EQ(hear("rear").status, Status::lost);
  EXPECT_EQ(rear_->updates, 1);
  EXPECT_EQ(hear("rear").reason, "nothing fits");
  EXPECT_EQ(rear_->updates, 2);
}

TEST_F(TwoParrots, AreNotStartedByWhatIsNoPose) {
  both_.start_at({std::nan(""), 0.0, 0.0});
  const PoseEstimate told = both_.update(Odometry{});
  EXPECT_EQ(told.status, Status::not_started);
  EXPECT_TRUE(told.map_from_base.is_finite());
}

TEST_F(TwoParrots, AScanOfNobodyIsToldAndChangesNothing) {
  both_.start_at({1.0, 1.0, 0.0});
  front_->says = sure_of({1.0, 1.0, 0.0});
  hear("front");
  const PoseEstimate told = hear("top");
  EXPECT_EQ(told.status, Status::not_a_scan);
  EXPECT_EQ(told.map_from_base, (Pose2{1.0, 1.0, 0.0}));
}

}  // namespace
}  // namespace beaconless
