// SPDX-License-Identifier: Apache-2.0
// What every method has to do, whatever it takes from a scan.
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "beaconless/io/scenario_io.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

sim::Scenario scenario(const std::string& name) {
  return io::read_scenario(std::string(BEACONLESS_SOURCE_DIR) + "/data/scenarios/" + name + ".yaml").value();
}

std::vector<PoseEstimate> follow(Localizer& localizer, const sim::SimulatedRun& drive) {
  localizer.start_at(drive.truth.front().pose);
  std::vector<PoseEstimate> estimates;
  estimates.reserve(drive.events.size());
  for (const Event& event : drive.events) estimates.push_back(localizer.update(event));
  return estimates;
}

class EachMethod : public testing::TestWithParam<Method> {
 protected:
  std::unique_ptr<Localizer> on(const Map& map, const Pose2& base_from_laser = {}) const {
    return make_localizer({.method = GetParam().name, .base_from_laser = base_from_laser}, map).value();
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EachMethod, testing::ValuesIn(methods().begin(), methods().end()),
                         [](const auto& method) {
                           std::string word = method.param.name;
                           for (char& letter : word) letter = letter == '-' || letter == '+' ? '_' : letter;
                           return word;
                         });

TEST_P(EachMethod, FollowsADriveAndIsNeverOkFarFromTheTruth) {
  sim::Scenario s = scenario("room-ellipse-people");
  s.duration_s = 20.0;
  const auto drive = sim::simulate(s).value();
  const auto estimates = follow(*on(s.plan, s.base_from_laser), drive);
  int ok = 0;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const double error_m = distance_m(estimates[i].map_from_base, drive.truth[i].pose);
    ASSERT_NE(estimates[i].status, Status::lost) << i;
    ASSERT_EQ(estimates[i].reason.empty(), estimates[i].ok());
    if (!estimates[i].ok()) continue;
    ++ok;
    ASSERT_LT(error_m, 0.1) << "scan " << i;
  }
  EXPECT_GT(ok, 700) << "of " << estimates.size();
}

TEST_P(EachMethod, GivesTheSameBitsTwice) {
  sim::Scenario s = scenario("room-ellipse");
  s.duration_s = 2.0;
  const auto drive = sim::simulate(s).value();
  EXPECT_EQ(follow(*on(s.plan, s.base_from_laser), drive), follow(*on(s.plan, s.base_from_laser), drive));
}

TEST_P(EachMethod, AllocatesNothingPerScanWhileItTracks) {
  sim::Scenario s = scenario("room-position-2");
  s.duration_s = 1.5;
  const auto drive = sim::simulate(s).value();
  const auto localizer = on(s.plan, s.base_from_laser);
  localizer->start_at(drive.truth.front().pose);
  // Buffers grow to what a scan needs at most, and what is remembered fills up.
  for (std::size_t i = 0; i < 40; ++i) localizer->update(drive.events[i]);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  for (std::size_t i = 40; i < drive.events.size(); ++i) {
    const std::size_t at_first = test::allocations();
    const PoseEstimate estimate = localizer->update(drive.events[i]);
    if (!estimate.ok()) continue;  // a search allocates; it is for times of trouble
    ASSERT_EQ(test::allocations(), at_first) << i;
  }
}

TEST_P(EachMethod, IsTotalOnAnyScanAtAnyTime) {
  Rng rng(8);
  const auto localizer = on(scenario("room-ellipse").plan);
  localizer->start_at({6, 4, 0});
  for (int i = 0; i < 60; ++i) {
    RawScan raw{.stamp = {static_cast<std::int64_t>(rng.bits() >> 1U)},
                .angle_min_rad = static_cast<float>(rng.uniform(-4, 4)),
                .angle_increment_rad = static_cast<float>(rng.uniform(-0.1, 0.1)),
                .range_max_m = 30.0F};
    const auto count = static_cast<std::size_t>(rng.uniform(1, 1200));
    raw.ranges_m.reserve(count);
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
    ASSERT_FALSE(estimate.ok()) << "noise must not be taken for a good fit";
  }
}

TEST_P(EachMethod, AStartInTheWrongPlaceIsNotBelievedAndTheRightOneFound) {
  Rng rng(13);
  const sim::Scenario s = scenario("room-ellipse");
  const RayCaster walls(s.plan.segments());
  const auto localizer = on(s.plan);
  const Pose2 truth{6, 4, 0.3};
  localizer->start_at({100, 100, 0});
  PoseEstimate estimate;
  for (int i = 0; i < 20; ++i) {
    estimate = localizer->update(Scan::make(test::sweep(walls, truth, 0.01, rng, {25'000'000L * i})).value());
    if (estimate.ok()) {
      ASSERT_LT(distance_m(estimate.map_from_base, truth), 0.1) << i;
    } else {
      ASSERT_GT(estimate.covariance(0, 0), 0.2 * 0.2) << i << ": " << estimate.reason;
    }
  }
  // Particles take a drive.
  if (!GetParam().name.starts_with("amcl")) {
    EXPECT_LT(distance_m(estimate.map_from_base, truth), 0.1) << estimate.reason;
  }
}

/// A start a foot and some degrees away is what people give.
TEST_P(EachMethod, FindsItselfFromARoughStart) {
  sim::Scenario s = scenario("room-ellipse");
  s.duration_s = 1.0;
  const auto drive = sim::simulate(s).value();
  const auto localizer = on(s.plan, s.base_from_laser);
  localizer->start_at(drive.truth.front().pose * Pose2{0.2, -0.2, radians(8.0)});
  for (std::size_t i = 0; i < drive.events.size(); ++i) {
    const PoseEstimate estimate = localizer->update(drive.events[i]);
    if (i + 10 < drive.events.size()) continue;
    ASSERT_LT(distance_m(estimate.map_from_base, drive.truth[i].pose), 0.06) << to_string(estimate.status);
  }
}

/// Corner ICP with too little in view coasts, less sure with every scan, and says so.
TEST(FeatureMethods, CoastWhenFewerThanTwoFeaturesAreInView) {
  Rng rng(14);
  const FloorPlan plan = test::rectangle(6, 5);
  const RayCaster walls(plan.segments());
  const auto localizer = make_localizer({.method = "icp-corners"}, plan).value();
  const Pose2 truth{3, 2.5, 0.2};
  localizer->start_at(truth);
  std::int64_t tick = 0;
  const auto see = [&](bool narrow) {
    RawScan raw = test::sweep(walls, truth, 0.01, rng, {25'000'000 * tick++});
    // Nothing returns but what lies ahead, where there is a wall and no corner.
    for (std::size_t i = 0; narrow && i < raw.ranges_m.size(); ++i)
      if (i < 480 || i > 600) raw.ranges_m[i] = std::numeric_limits<float>::infinity();
    return localizer->update(Scan::make(raw).value());
  };
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(see(false).ok());
  double before = 0.0;
  for (int i = 0; i < 5; ++i) {
    const PoseEstimate estimate = see(true);
    ASSERT_EQ(estimate.status, Status::degraded);
    ASSERT_NE(estimate.reason.find("fewer than two features"), std::string_view::npos) << estimate.reason;
    ASSERT_GT(estimate.covariance(0, 0), before);
    before = estimate.covariance(0, 0);
  }
  EXPECT_TRUE(see(false).ok());
}

/// Corners that are only remembered keep the pose where it was, but nobody calls that ok.
TEST(FeatureMethods, RememberedCornersBridgeAGlimpse) {
  Rng rng(15);
  const FloorPlan plan = test::rectangle(6, 5);
  const RayCaster walls(plan.segments());
  for (const bool tracked : {false, true}) {
    const auto localizer =
        make_localizer({.method = tracked ? "icp-corners-ft" : "icp-corners"}, plan).value();
    const Pose2 truth{3, 2.5, 0.2};
    localizer->start_at(truth);
    for (int i = 0; i < 40; ++i) {
      const bool is_glimpse = i % 4 == 3;
      RawScan raw = test::sweep(walls, truth, 0.01, rng, {25'000'000L * i});
      for (std::size_t k = 0; is_glimpse && k < raw.ranges_m.size(); ++k)
        if (k < 480 || k > 600) raw.ranges_m[k] = std::numeric_limits<float>::infinity();
      const PoseEstimate estimate = localizer->update(Scan::make(raw).value());
      EXPECT_EQ(estimate.ok(), !is_glimpse) << i;
      const bool rests_on_memory = estimate.reason.find("remembered") != std::string_view::npos;
      EXPECT_EQ(rests_on_memory, is_glimpse && tracked) << estimate.reason;
      EXPECT_LT(distance_m(estimate.map_from_base, truth), 0.02);
    }
  }
}

/// Where features do not suffice and the motion no longer tells, the whole scan does, and that is not ok.
TEST(FeatureMethods, TheWholeScanStandsInForThem) {
  Rng rng(16);
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  // A method that never has enough to hold on to.
  LocalizerConfig config{.method = "icp-corners"};
  const auto fields = fields_of(config);
  ASSERT_TRUE(set_field(fields, "feature_icp.min_pairs", "1000").ok());
  const auto localizer = make_localizer(config, plan).value();
  const Pose2 truth{3, 2, 0.3};
  localizer->start_at(truth * Pose2{0.15, -0.1, 0.1});
  for (int i = 0; i < 10; ++i) {
    const PoseEstimate estimate =
        localizer->update(Scan::make(test::sweep(walls, truth, 0.01, rng, {25'000'000L * i})).value());
    ASSERT_EQ(estimate.status, Status::degraded) << i;
    EXPECT_LT(distance_m(estimate.map_from_base, truth), 0.02) << i;
  }
}

/// Whatever is in view, a covariance is one: no direction has a negative variance.
TEST_P(EachMethod, CovariancesHaveNoNegativeDirection) {
  Rng rng(17);
  const sim::Scenario s = scenario("room-ellipse");
  const RayCaster walls(s.plan.segments());
  const auto localizer = on(s.plan);
  const Pose2 truth{6, 4, 0.3};
  localizer->start_at(truth);
  for (int i = 0; i < 36; ++i) {
    RawScan raw = test::sweep(walls, truth, 0.01, rng, {125'000'000L * i});
    for (std::size_t k = 0; i % 12 >= 5 && k < raw.ranges_m.size(); ++k)
      if (k < 480 || k > 600) raw.ranges_m[k] = std::numeric_limits<float>::infinity();
    const PoseEstimate estimate = localizer->update(Scan::make(raw).value());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(estimate.covariance);
    ASSERT_GE(solver.eigenvalues()[0], 0.0) << i << " " << estimate.reason;
  }
}

TEST(FeatureMethods, SayWhatAMapLacks) {
  // A bare corridor has no corners.
  const FloorPlan corridor{{{{-50, 0}, {50, 0}}, {{-50, 2.5}, {50, 2.5}}}};
  const auto made = make_localizer({.method = "icp-corners"}, corridor);
  ASSERT_FALSE(made.ok());
  EXPECT_FALSE(made.error().remedy.empty());
}

TEST(Methods, AreThoseOfTheDissertationByName) {
  std::vector<std::string> names;
  for (const Method& method : methods()) names.push_back(method.name);
  for (const char* name : {"icp-full", "icp-rdp", "icp-corners", "icp-corners-ft", "icp-oc", "icp-falko",
                           "icp-flirt-blob", "icp-flirt-edge", "icp-flirt-range", "icp-flirt-curvature",
                           "hector-full", "hector-keypoints", "hector-regions"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

}  // namespace
}  // namespace beaconless
