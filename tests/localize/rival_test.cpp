// SPDX-License-Identifier: Apache-2.0
// A hall whose pillars all look alike: where a scan fits two places, no pose is ok until one of them fits no
// more.
#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kPeriod_m = 0.8;
constexpr double kRange_m = 6.0;

/// 60 m long; pillars stand along both walls from 10 m to 50 m.
FloorPlan pillar_hall() {
  FloorPlan hall{{{{0, 0}, {60, 0}, {60, 4}, {0, 4}, {0, 0}}}};
  for (int k = 0; k <= 50; ++k)
    for (const double y : {0.4, 3.2}) {
      const double x = 10.0 + kPeriod_m * k;
      hall.walls.push_back({{x, y}, {x + 0.3, y}, {x + 0.3, y + 0.4}, {x, y + 0.4}, {x, y}});
    }
  return hall;
}

class Rival : public testing::TestWithParam<double> {  // how far from the truth the start is
 protected:
  PoseEstimate see(const Pose2& truth) {
    RawScan raw = test::sweep(walls_, truth, 0.01, rng_, {25'000'000 * scans_++});
    raw.range_max_m = static_cast<float>(kRange_m);
    return localizer_->update(Scan::make(raw).value());
  }

  FloorPlan hall_ = pillar_hall();
  RayCaster walls_{hall_.segments()};
  std::unique_ptr<Localizer> localizer_ = make_localizer({}, hall_).value();
  Rng rng_{5};
  std::int64_t scans_ = 0;
};

TEST_P(Rival, IsToldFollowedAndGoneWhereOnePlaceFitsNoMore) {
  Pose2 truth{38.0, 2.0, 0.0};
  localizer_->start_at({truth.x_m + GetParam(), truth.y_m, truth.theta_rad});
  const PoseEstimate first = see(truth);
  EXPECT_EQ(first.status, Status::degraded);
  EXPECT_EQ(first.reason, "another place nearby fits the scan nearly as well");
  // As wide as the way to the other place.
  EXPECT_GT(std::sqrt(first.covariance(0, 0)), 0.9 * kPeriod_m);

  // The pillars end at 50 m, the hall at 60 m: one after the other comes in sight and tells the places apart.
  PoseEstimate last = first;
  while (truth.x_m < 57.0) {
    truth.x_m += 0.02;
    last = see(truth);
    if (last.ok()) {
      const double sigma_m = std::sqrt(last.covariance.topLeftCorner<2, 2>().trace());
      EXPECT_LT(distance_m(last.map_from_base, truth), 4.0 * sigma_m + 1e-3) << truth;
      EXPECT_LT(sigma_m, 0.1 * kPeriod_m);
      EXPECT_GT(truth.x_m, 50.3 - kRange_m);
    }
  }
  EXPECT_TRUE(last.ok()) << last.reason;
  EXPECT_LT(std::sqrt(last.covariance(0, 0)), 0.005);
}

TEST_P(Rival, IsForgottenAtANewStart) {
  localizer_->start_at({38.0 + GetParam(), 2.0, 0.0});
  ASSERT_EQ(see({38.0, 2.0, 0.0}).status, Status::degraded);
  localizer_->start_at({2.0, 2.0, kPi});
  const PoseEstimate there = see({2.0, 2.0, kPi});
  EXPECT_TRUE(there.ok()) << there.reason;
}

// Nearer to the true place, and nearer to the wrong one.
INSTANTIATE_TEST_SUITE_P(Starts, Rival, testing::Values(0.0, 0.1, 0.3, 0.5, 0.7));

}  // namespace
}  // namespace beaconless
