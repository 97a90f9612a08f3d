// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/scenario.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/sim/drive.hpp"

namespace beaconless::sim {
namespace {

Scenario small_turn() {
  Scenario scenario;
  scenario.plan = {{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}}}};
  scenario.path = Turning{.angle_deg = 90.0};
  scenario.duration_s = 2.0;
  return scenario;
}

TEST(Simulate, GivesAScanAndATruePoseOfTheBaseForEachSweep) {
  const Scenario scenario = small_turn();
  const SimulatedRun run = simulate(scenario).value();
  ASSERT_EQ(run.events.size(), 80U);
  ASSERT_EQ(run.truth.size(), 80U);
  const Drive drive(scenario.path);
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    EXPECT_EQ(stamp_of(run.events[i]), run.truth[i].stamp);
    EXPECT_EQ(run.truth[i].stamp.ns, static_cast<std::int64_t>(i) * 25'000'000);
    EXPECT_EQ(run.truth[i].pose, drive.map_from_base(static_cast<double>(i) / 40.0));
  }
}

TEST(Simulate, TheLaserIsAheadOfTheBase) {
  Scenario scenario = small_turn();
  scenario.path = Standing{};
  scenario.lidar.range_sigma_m = 0.0;
  scenario.duration_s = 0.025;
  const SimulatedRun run = simulate(scenario).value();
  ASSERT_EQ(run.events.size(), 1U);
  EXPECT_NEAR(static_cast<double>(std::get<Scan>(run.events[0]).ranges_m()[540]), 2.3, 1e-6);
}

TEST(Simulate, SameSeedSameBitsOtherSeedOtherNoise) {
  Scenario scenario = small_turn();
  const SimulatedRun first = simulate(scenario).value();
  EXPECT_EQ(first.events, simulate(scenario).value().events);
  scenario.seed = 2;
  const SimulatedRun second = simulate(scenario).value();
  EXPECT_NE(first.events, second.events);
  EXPECT_EQ(first.truth, second.truth);
}

TEST(Simulate, AShorterRunIsTheBeginningOfALongerOne) {
  Scenario scenario = small_turn();
  const SimulatedRun whole = simulate(scenario).value();
  scenario.duration_s = 1.0;
  const SimulatedRun half = simulate(scenario).value();
  ASSERT_EQ(half.events.size(), 40U);
  EXPECT_TRUE(std::equal(half.events.begin(), half.events.end(), whole.events.begin()));
}

TEST(Simulate, RefusesWhatCannotBeAndNamesIt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto where = [](auto&& change) {
    Scenario scenario = small_turn();
    change(scenario);
    const auto run = simulate(scenario);
    return run ? std::string("accepted") : run.error().where;
  };
  EXPECT_EQ(where([](Scenario& s) { s.lidar.beam_count = -1; }), "lidar.beam_count");
  EXPECT_EQ(where([&](Scenario& s) { s.lidar.rate_hz = nan; }), "lidar.rate_hz");
  EXPECT_EQ(where([](Scenario& s) { s.lidar.angle_max_deg = -140; }), "lidar.angle_max_deg");
  EXPECT_EQ(where([](Scenario& s) { s.lidar.angle_max_deg = 300; }), "lidar.angle_max_deg");
  EXPECT_EQ(where([](Scenario& s) { s.lidar.range_max_m = 0.05; }), "lidar.range_max_m");
  EXPECT_EQ(where([](Scenario& s) { s.duration_s = 1e9; }), "duration_s");
  EXPECT_EQ(where([&](Scenario& s) { s.duration_s = nan; }), "duration_s");
  EXPECT_EQ(where([&](Scenario& s) { s.base_from_laser.x_m = nan; }), "base_from_laser");
  EXPECT_EQ(where([](Scenario& s) { s.path = Ellipse{.speed_mps = 0.0}; }), "path.speed_mps");
  EXPECT_EQ(where([](Scenario& s) { s.path = Waypoints{}; }), "path.points");
  EXPECT_EQ(where([](Scenario& s) { s.people = {Person{}}; }), "people.waypoints");
  EXPECT_EQ(where([&](Scenario& s) { s.people = {Person{.waypoints = {{nan, 0}}}}; }), "people.waypoints");
}

}  // namespace
}  // namespace beaconless::sim
