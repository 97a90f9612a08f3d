// SPDX-License-Identifier: Apache-2.0
// Monte-Carlo localization beyond what every method has to do: wheels, starts anywhere, kidnapping, polish.
#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr std::int64_t kTick_ns = 100'000'000;

/// A robot in a room that drives where it is told, with a scan and a reading of its wheels every tick.
class Drive {
 public:
  Drive(const Map& map, const FloorPlan& plan, const std::string& method, bool has_wheels)
      : localizer(make_localizer({.method = method}, map).value()),
        walls_(plan.segments()),
        has_wheels_(has_wheels) {}

  PoseEstimate go(const Pose2& motion) {
    truth = truth * motion;
    wheels_ = wheels_ * Pose2{motion.x_m * (1.0 + rng_.normal(0.02)), motion.y_m,
                              motion.theta_rad * (1.0 + rng_.normal(0.02))};
    const Stamp stamp{kTick_ns * ticks_++};
    if (has_wheels_) localizer->update(Odometry{stamp, wheels_, std::nullopt, ""});
    return localizer->update(Scan::make(test::sweep(walls_, truth, 0.01, rng_, stamp)).value());
  }

  void carry_to(const Pose2& there) { truth = there; }

  /// Around a circle of about a metre.
  PoseEstimate circle() { return go({0.05, 0.0, 0.05}); }

  std::unique_ptr<Localizer> localizer;
  Pose2 truth{3.5, 1.0, 0.0};

 private:
  RayCaster walls_;
  Rng rng_{3};
  Pose2 wheels_;
  bool has_wheels_;
  std::int64_t ticks_ = 0;
};

struct Case {
  const char* method;
  bool is_grid;
  bool has_wheels;
};

class Amcl : public testing::TestWithParam<Case> {
 protected:
  FloorPlan plan_ = test::niche_room();
  Map map_ = GetParam().is_grid ? Map(rasterize(plan_, {.resolution_m = 0.05}).value()) : Map(plan_);
  Drive drive_{map_, plan_, GetParam().method, GetParam().has_wheels};
};

INSTANTIATE_TEST_SUITE_P(Cases, Amcl,
                         testing::Values(Case{"amcl", false, true}, Case{"amcl", false, false},
                                         Case{"amcl", true, true}, Case{"amcl", true, false},
                                         Case{"amcl+walls", false, true}, Case{"amcl+walls", true, false}),
                         [](const auto& of) {
                           return std::string(of.param.method).substr(0, 4) +
                                  (std::string(of.param.method).size() > 4 ? "_walls" : "") +
                                  (of.param.is_grid ? "_grid" : "_plan") +
                                  (of.param.has_wheels ? "_wheels" : "_laser");
                         });

TEST_P(Amcl, FollowsADriveAndIsNeitherLostNorTooSure) {
  drive_.localizer->start_at(drive_.truth * Pose2{0.1, -0.1, 0.1});
  double squares = 0.0;
  double nees = 0.0;
  constexpr int kTicks = 250;
  for (int i = 0; i < kTicks; ++i) {
    const PoseEstimate estimate = drive_.circle();
    ASSERT_TRUE(estimate.ok()) << i << " " << estimate.reason;
    ASSERT_TRUE(drive_.localizer->candidates().empty());
    if (i < 50) continue;
    ASSERT_FALSE(estimate.jumped) << i;
    squares += std::pow(distance_m(estimate.map_from_base, drive_.truth), 2) / (kTicks - 50);
    const Eigen::Vector3d off(estimate.map_from_base.x_m - drive_.truth.x_m,
                              estimate.map_from_base.y_m - drive_.truth.y_m,
                              wrap_angle(estimate.map_from_base.theta_rad - drive_.truth.theta_rad));
    nees += off.dot(estimate.covariance.inverse() * off) / (kTicks - 50);
  }
  const bool is_polished = GetParam().method == std::string("amcl+walls");
  EXPECT_LT(std::sqrt(squares), is_polished ? (GetParam().is_grid ? 0.015 : 0.001) : 0.04);
  if (!GetParam().is_grid) {
    EXPECT_LT(nees, is_polished ? 4.5 : 3.5);
  }
}

TEST_P(Amcl, FindsItselfAnywhereOnceItHasMoved) {
  drive_.localizer->start_anywhere();
  bool has_told_candidates = false;
  int ok = 0;
  for (int i = 0; i < 250; ++i) {
    const PoseEstimate estimate = drive_.circle();
    ASSERT_TRUE(estimate.map_from_base.is_finite() && estimate.covariance.allFinite());
    has_told_candidates = has_told_candidates || !drive_.localizer->candidates().empty();
    double weights = 0.0;
    for (const PoseCandidate& candidate : drive_.localizer->candidates()) weights += candidate.weight;
    if (weights > 0.0) {
      ASSERT_NEAR(weights, 1.0, 1e-9);
    }
    if (i == 0) {
      EXPECT_EQ(estimate.status, Status::relocalizing);
    }
    if (!estimate.ok()) continue;
    ++ok;
    ASSERT_LT(distance_m(estimate.map_from_base, drive_.truth), 0.3) << i;
  }
  EXPECT_TRUE(has_told_candidates);
  EXPECT_GT(ok, 100);
}

TEST_P(Amcl, IsFoundAgainAfterItWasCarriedAway) {
  drive_.localizer->start_at(drive_.truth);
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(drive_.circle().ok());
  drive_.carry_to({1.2, 3.9, -2.6});
  bool was_lost = false;
  int ok_at_last = 0;
  for (int i = 0; i < 400; ++i) {
    const PoseEstimate estimate = drive_.go({0.02, 0.0, 0.06});
    was_lost = was_lost || estimate.status == Status::lost;
    const bool is_right = distance_m(estimate.map_from_base, drive_.truth) < 0.25;
    ok_at_last = estimate.ok() && is_right ? ok_at_last + 1 : 0;
    if (i > 20 && estimate.ok()) {
      ASSERT_TRUE(is_right) << i;
    }
  }
  EXPECT_TRUE(was_lost);
  EXPECT_GT(ok_at_last, 50);
}

TEST(AmclLocalizer, WithWheelsTheCloudIsWeighedOnlyEverySoFar) {
  const FloorPlan plan = test::niche_room();
  Drive drive(plan, plan, "amcl", true);
  drive.localizer->start_at(drive.truth);
  for (int i = 0; i < 60; ++i) drive.circle();
  int weighed = 0;
  double before = 0.0;
  constexpr int kTicks = 40;
  for (int i = 0; i < kTicks; ++i) {
    const double now = drive.circle().covariance.topLeftCorner<2, 2>().trace();
    if (now < before) ++weighed;
    before = now;
  }
  // 5 cm a tick, an update every 20 cm; between them the covariance only grows.
  EXPECT_NEAR(weighed, kTicks / 4, 3);
  // Where it stands, nothing is learnt.
  const PoseEstimate standing = drive.go({});
  for (int i = 0; i < 10; ++i)
    EXPECT_LT(distance_m(drive.go({}).map_from_base, standing.map_from_base), 1e-9);
}

TEST(AmclLocalizer, AStartWithinARegionStaysThere) {
  const FloorPlan plan = test::niche_room();
  Drive drive(plan, plan, "amcl", true);
  drive.localizer->start_anywhere(SearchRegion{{3.5, 1.0}, 0.7});
  PoseEstimate estimate;
  for (int i = 0; i < 40; ++i) {
    estimate = drive.circle();
    EXPECT_LT(distance_m(estimate.map_from_base, drive.truth), 2.0) << i;
  }
  EXPECT_TRUE(estimate.ok()) << estimate.reason;
}

TEST(AmclLocalizer, AStartBeyondAllMapsGivesFiniteNumbers) {
  const FloorPlan plan = test::niche_room();
  for (const char* method : {"amcl", "amcl+walls"}) {
    Drive drive(plan, plan, method, true);
    drive.localizer->start_at({1e300, -1e300, 1e9});
    for (int i = 0; i < 30; ++i) {
      const PoseEstimate estimate = drive.circle();
      ASSERT_TRUE(estimate.map_from_base.is_finite() && estimate.covariance.allFinite()) << i;
      ASSERT_FALSE(estimate.ok()) << i;
    }
  }
}

/// A scan that hits in so many directions, two metres away.
Scan scan_of_hits(std::size_t hits) {
  RawScan raw{.angle_min_rad = 0.0F, .angle_increment_rad = 0.01F, .range_max_m = 10.0F};
  raw.ranges_m.assign(100, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < hits; ++i) raw.ranges_m[20 * i] = 2.0F;
  return Scan::make(raw).value();
}

TEST(AmclLocalizer, OfPlacesThatAScanMayBeFromEachExplainsSomeOfIt) {
  for (const std::size_t hits : {1U, 2U, 4U}) {
    const auto localizer = make_localizer({.method = "amcl"}, test::rack_hall()).value();
    localizer->start_anywhere();
    localizer->update(scan_of_hits(hits));
    ASSERT_FALSE(localizer->candidates().empty());
    double weights = 0.0;
    for (const PoseCandidate& candidate : localizer->candidates()) {
      EXPECT_GT(candidate.score, 0.0);
      weights += candidate.weight;
    }
    EXPECT_NEAR(weights, 1.0, 1e-9);
  }
}

TEST(AmclLocalizer, AScanWithoutHitsMayBeFromNoPlaceThatIsNamed) {
  const auto localizer = make_localizer({.method = "amcl"}, test::niche_room()).value();
  localizer->start_anywhere();
  EXPECT_FALSE(localizer->update(scan_of_hits(0)).ok());
  EXPECT_TRUE(localizer->candidates().empty());
}

TEST(AmclLocalizer, AScanWithoutHitsIsNotOk) {
  const FloorPlan plan = test::niche_room();
  const auto localizer = make_localizer({.method = "amcl"}, plan).value();
  localizer->start_at({3, 2, 0});
  RawScan raw{.angle_min_rad = 0.0F, .angle_increment_rad = 0.01F, .range_max_m = 10.0F};
  raw.ranges_m.assign(100, std::numeric_limits<float>::infinity());
  const PoseEstimate estimate = localizer->update(Scan::make(raw).value());
  EXPECT_FALSE(estimate.ok());
  EXPECT_FALSE(estimate.reason.empty());
}

}  // namespace
}  // namespace beaconless
