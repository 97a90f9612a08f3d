// SPDX-License-Identifier: Apache-2.0
// Going on from the last pose: where it fits, and anywhere where it does not.
#include "apps/beaconless/resuming_localizer.hpp"

#include <gmock/gmock.h>

#include "tests/apps/fake_localizer.hpp"
#include "tests/apps/kept_recording.hpp"

namespace beaconless::cli {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr Pose2 kLast{1.0, 2.0, 3.0};

struct Resuming {
  explicit Resuming(std::vector<FakeLocalizer::Answer> there) {
    auto fake = std::make_unique<FakeLocalizer>();
    within = fake.get();
    within->after_start_at = std::move(there);
    within->after_start_anywhere = {{Status::relocalizing}, {Status::ok, {7.0, 7.0, 0.0}}};
    localizer = std::make_unique<ResumingLocalizer>(std::move(fake), kLast);
  }
  std::vector<Status> drive(std::size_t scans) {
    std::vector<Status> statuses;
    for (const Event& event : drive_of(scans)) {
      const PoseEstimate estimate = localizer->update(event);
      if (std::holds_alternative<Scan>(event)) statuses.push_back(estimate.status);
    }
    return statuses;
  }

  FakeLocalizer* within = nullptr;
  std::unique_ptr<ResumingLocalizer> localizer;
};

TEST(ResumingLocalizer, GoesOnWhereItWas) {
  Resuming run({{Status::degraded}, {Status::ok}, {Status::lost}});
  EXPECT_THAT(run.drive(10), SizeIs(10));
  ASSERT_THAT(run.within->starts, SizeIs(1));
  EXPECT_EQ(run.within->starts.front(), kLast);
  EXPECT_THAT(run.within->searches, IsEmpty()) << "once it fitted, it is the localizer's own affair";
  EXPECT_FALSE(run.localizer->has_searched());
}

TEST(ResumingLocalizer, LooksEverywhereWhereItDoesNotFit) {
  Resuming run({{Status::degraded}, {Status::degraded}, {Status::lost}, {Status::ok}});
  EXPECT_THAT(run.drive(5), testing::ElementsAre(Status::degraded, Status::degraded, Status::relocalizing,
                                                 Status::ok, Status::ok));
  ASSERT_THAT(run.within->searches, SizeIs(1));
  EXPECT_FALSE(run.within->searches.front()) << "anywhere on the map";
  EXPECT_EQ(run.within->scans[1].front(), Stamp::from_seconds(2.0)) << "the third scan is searched with too";
  EXPECT_TRUE(run.localizer->has_searched());
}

TEST(ResumingLocalizer, AnotherStartEndsTheTrial) {
  Resuming run({{Status::lost}});
  run.localizer->start_at({5.0, 5.0, 0.0});
  run.drive(5);
  EXPECT_THAT(run.within->searches, IsEmpty());
}

}  // namespace
}  // namespace beaconless::cli
