// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/scan_evidence.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "beaconless/match/see_through.hpp"

#include "tests/support/people.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kSigma_m = 0.05;
constexpr std::size_t kAllBeams = 100000;
const Pose2 kTruth{2.0, 1.5, 0.4};

struct Seen {
  FloorPlan plan = test::niche_room();
  SurfaceMap map = build_surface_map(plan, 0.6).value();
  std::vector<Eigen::Vector2d> points;
};

Seen seen_from(const Pose2& pose, double people_share = 0.0) {
  Seen seen;
  Rng rng(3);
  RawScan raw = test::sweep(RayCaster(seen.plan.segments()), pose, 0.01, rng);
  if (people_share > 0.0) raw = test::among_people(raw, people_share, rng);
  seen.points = test::points_of(Scan::make(raw).value());
  return seen;
}

/// The same sums by every wall there is, and rays that are followed exactly.
ScanEvidence weigh_slowly(const Seen& seen, const Pose2& pose) {
  const RayCaster walls(seen.plan.segments());
  const auto is_met = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& way, double length_m) {
    return walls.cast(from, way, length_m - std::max(0.12, 4.0 * kSigma_m)).has_value();
  };
  ScanEvidence sum{.log_likelihood = 0.0};
  const auto beams = static_cast<double>(seen.points.size());
  for (const Eigen::Vector2d& point : seen.points) {
    const Eigen::Vector2d end = pose * point;
    double distance_m = 0.6;
    for (const Segment2& wall : walls.segments()) distance_m = std::min(distance_m, wall.distance_m(end));
    const bool is_on = distance_m < 2.0 * kSigma_m;
    const Eigen::Vector2d way = (end - pose.translation()).normalized();
    const Eigen::Vector2d aside = kSigma_m * Eigen::Vector2d(-way.y(), way.x());
    const double length_m = point.norm();
    const bool is_through = is_met(pose.translation(), way, length_m) &&
                            is_met(pose.translation() + aside, way, length_m) &&
                            is_met(pose.translation() - aside, way, length_m);
    (is_through ? sum.through : is_on ? sum.on_map : sum.in_front) += 1.0 / beams;
    const double z = distance_m / kSigma_m;
    sum.log_likelihood +=
        std::log(is_through ? (is_on ? 0.1 : 0.02) : 0.9 * std::exp(-0.5 * z * z) + 0.1) / beams;
  }
  return sum;
}

TEST(ScanEvidence, IsThatOfEveryWallAndExactRays) {
  Rng rng(11);
  double most_through = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Seen seen = seen_from(kTruth, i % 3 == 0 ? 0.3 : 0.0);
    const Pose2 pose =
        i == 0 ? kTruth : Pose2{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.2), rng.uniform(-3.0, 3.0)};
    const ScanEvidence fast = weigh_scan(seen.points, seen.map, pose, kSigma_m, kAllBeams);
    const ScanEvidence slow = weigh_slowly(seen, pose);
    // A beam within 1.5 cm of a corner counts as stopped by it, which an exact ray is not.
    EXPECT_NEAR(fast.on_map, slow.on_map, 0.012) << i;
    EXPECT_NEAR(fast.in_front, slow.in_front, 0.012) << i;
    EXPECT_NEAR(fast.through, slow.through, 0.012) << i;
    EXPECT_NEAR(fast.log_likelihood, slow.log_likelihood, 0.02) << i;
    most_through = std::max(most_through, slow.through);
  }
  EXPECT_GT(most_through, 0.2);  // or nothing was put to the test
}

TEST(ScanEvidence, ItsSharesAddUpToOneWhateverThePoseAndTheBeams) {
  const Seen seen = seen_from(kTruth, 0.2);
  Rng rng(2);
  for (const std::size_t beams : {1UL, 7UL, 120UL, 400UL, kAllBeams})
    for (int i = 0; i < 10; ++i) {
      const Pose2 pose{rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0), rng.uniform(-3.0, 3.0)};
      const ScanEvidence evidence = weigh_scan(seen.points, seen.map, pose, kSigma_m, beams);
      EXPECT_NEAR(evidence.on_map + evidence.in_front + evidence.through, 1.0, 1e-12);
      EXPECT_LE(evidence.log_likelihood, 0.0);
      EXPECT_GE(evidence.log_likelihood, std::log(0.02) - 1e-12);
    }
}

TEST(ScanEvidence, IsBestWhereTheLaserIs) {
  const Seen seen = seen_from(kTruth);
  const ScanEvidence there = weigh_scan(seen.points, seen.map, kTruth, kSigma_m, 400);
  EXPECT_GT(there.on_map, 0.99);
  EXPECT_EQ(there.through, 0.0);
  EXPECT_GT(there.log_likelihood, -0.05);
  for (const Pose2& off : {Pose2{0.1, 0, 0}, Pose2{0, -0.1, 0}, Pose2{0, 0, 0.05}}) {
    EXPECT_LT(weigh_scan(seen.points, seen.map, kTruth * off, kSigma_m, 400).log_likelihood,
              there.log_likelihood - 0.05);
  }
}

TEST(ScanEvidence, PeopleInFrontTakeFromOnMapAndAddNothingToThrough) {
  double before = 1.0;
  for (const double share : {0.1, 0.3, 0.6}) {
    const Seen seen = seen_from(kTruth, share);
    const ScanEvidence evidence = weigh_scan(seen.points, seen.map, kTruth, kSigma_m, kAllBeams);
    EXPECT_LT(evidence.on_map, before - 0.05);
    EXPECT_NEAR(evidence.in_front, share, 0.1);
    EXPECT_LT(evidence.through, 0.001);
    before = evidence.on_map;
  }
}

TEST(ScanEvidence, OfNothingIsTheLeastThereIs) {
  const Seen seen = seen_from(kTruth);
  EXPECT_EQ(weigh_scan({}, seen.map, kTruth, kSigma_m, 400), ScanEvidence{});
  const std::vector<Eigen::Vector2d> at_the_laser(3, Eigen::Vector2d::Zero());
  const ScanEvidence evidence = weigh_scan(at_the_laser, seen.map, kTruth, kSigma_m, 0);
  EXPECT_EQ(evidence.in_front, 1.0);
  EXPECT_TRUE(std::isfinite(evidence.log_likelihood));
}

/// One wall along x from 0 to 10 m, and beams of 5 m that cross it.
bool crosses(double from_y_m, double angle_deg, double slack_m, double from_x_m = 5.0) {
  const WallIndex map(FloorPlan{{{{0.0, 0.0}, {10.0, 0.0}}}});
  const double angle = radians(angle_deg);
  return passes_through(map, {from_x_m, from_y_m}, {std::cos(angle), std::sin(angle)}, 5.0, slack_m);
}

TEST(PassesThrough, ABeamFromTheFrontDoesWhateverTheSlack) {
  for (const double slack_m : {0.0, 0.05, 0.1, 0.2}) {
    EXPECT_TRUE(crosses(1.0, -90.0, slack_m)) << slack_m;
    EXPECT_TRUE(crosses(1.0, -60.0, slack_m)) << slack_m;
    EXPECT_FALSE(crosses(1.0, 90.0, slack_m)) << slack_m;
  }
}

TEST(PassesThrough, ABeamThatGrazesIsNoEvidenceIfTheWallMayBeOff) {
  // From 8 cm beside the wall it comes to it after 4.6 m; 10 cm further out it would not in time.
  EXPECT_TRUE(crosses(0.08, -1.0, 0.0, 1.0) || crosses(0.08, -1.5, 0.0, 1.0));
  EXPECT_FALSE(crosses(0.08, -1.5, 0.1, 1.0));
  EXPECT_TRUE(crosses(0.3, -20.0, 0.1, 1.0));
}

TEST(PassesThrough, ABeamPastTheEndOfAWallIsNoEvidenceIfTheWallMayBeShorter) {
  EXPECT_TRUE(crosses(1.0, -90.0, 0.0, 9.95));
  EXPECT_FALSE(crosses(1.0, -90.0, 0.1, 9.95));
  EXPECT_TRUE(crosses(1.0, -90.0, 0.1, 9.85));
}

TEST(PassesThrough, NeitherDoesOneThatEndsShortlyBehind) {
  EXPECT_FALSE(crosses(4.9, -90.0, 0.0));  // 0.1 m behind
  EXPECT_TRUE(crosses(4.85, -90.0, 0.0));
  EXPECT_FALSE(crosses(4.65, -90.0, 0.1));  // four slacks are more
  EXPECT_TRUE(crosses(4.55, -90.0, 0.1));
}

}  // namespace
}  // namespace beaconless
