// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/scenario_io.hpp"

#include <array>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/sim/drive.hpp"

namespace beaconless::io {
namespace {

const std::string kScenarios = std::string(BEACONLESS_SOURCE_DIR) + "/data/scenarios";

sim::Scenario scenario_of(const std::string& name) {
  return read_scenario(kScenarios + "/" + name + ".yaml").value();
}

/// The least distance between the robot (taken as the line from base to laser) and a wall.
double clearance_m(const sim::Scenario& scenario, double time_s) {
  const Pose2 map_from_base = sim::Drive(scenario.path).map_from_base(time_s);
  const Segment2 robot{map_from_base.translation(), (map_from_base * scenario.base_from_laser).translation()};
  double least = 1e9;
  for (const Segment2& wall : scenario.plan.segments())
    least = std::min({least, wall.distance_m(robot.a), wall.distance_m(robot.b), robot.distance_m(wall.a),
                      robot.distance_m(wall.b)});
  return least;
}

/// True where the walls are closed around a place: no ray gets out.
bool is_enclosed(const RayCaster& walls, const Eigen::Vector2d& place) {
  for (int i = 0; i < 360; ++i)
    if (!walls.cast(place, {std::cos(radians(i)), std::sin(radians(i))}, 100.0)) return false;
  return true;
}

TEST(Scenarios, TheSixOfTheDissertationAndTwoMoreAreThere) {
  EXPECT_THAT(scenario_names(kScenarios),
              testing::ElementsAre("room-ellipse", "room-ellipse-people", "room-ellipse-three-people",
                                   "room-position-1", "room-position-2", "small-drive", "small-rotation",
                                   "small-static"));
  EXPECT_THAT(scenario_names(kScenarios + "/nowhere"), testing::IsEmpty());
}

class EachScenario : public testing::TestWithParam<std::string> {};

TEST(Scenarios, TheDissertationsHaveTheirSweeps) {
  for (const char* name : {"small-static", "small-rotation", "room-position-1", "room-position-2"})
    EXPECT_EQ(scenario_of(name).sweep_count(), 400U) << name;
  for (const char* name : {"room-ellipse", "room-ellipse-people", "room-ellipse-three-people"})
    EXPECT_EQ(scenario_of(name).sweep_count(), 1600U) << name;
}

TEST_P(EachScenario, LoadsWithItsNameAndTheDissertationsRobot) {
  const sim::Scenario scenario = scenario_of(GetParam());
  EXPECT_EQ(scenario.name, GetParam());
  EXPECT_FALSE(scenario.description.empty());
  EXPECT_GT(scenario.sweep_count(), 0U);
  EXPECT_EQ(scenario.base_from_laser, (Pose2{0.7, 0.0, 0.0}));
  EXPECT_EQ(scenario.lidar.sweep, sim::Sweep::instantaneous);
  EXPECT_EQ(scenario.lidar.beam_count, 1081);
}

TEST_P(EachScenario, DrivesThroughNoWallAndStaysInTheRoom) {
  const sim::Scenario scenario = scenario_of(GetParam());
  const sim::Drive drive(scenario.path);
  const RayCaster walls(scenario.plan.segments());
  EXPECT_LE(drive.duration_s(), scenario.duration_s) << "the drive is over before the recording is";
  Eigen::Vector2d last = drive.map_from_base(0.0).translation();
  for (double t = 0.0; t <= scenario.duration_s; t += 0.05) {
    const Pose2 map_from_base = drive.map_from_base(t);
    EXPECT_GT(clearance_m(scenario, t), 0.3) << "at " << t << " s";
    EXPECT_TRUE(is_enclosed(walls, (map_from_base * scenario.base_from_laser).translation()))
        << "at " << t << " s";
    EXPECT_LT((map_from_base.translation() - last).norm(), 0.1)
        << "half of the least clearance: no wall is jumped";
    last = map_from_base.translation();
  }
}

TEST_P(EachScenario, KeepsPeopleAtADistance) {
  const sim::Scenario scenario = scenario_of(GetParam());
  const sim::Drive drive(scenario.path);
  for (double t = 0.0; t <= scenario.duration_s; t += 0.05) {
    const Pose2 map_from_base = drive.map_from_base(t);
    const Segment2 robot{map_from_base.translation(),
                         (map_from_base * scenario.base_from_laser).translation()};
    for (const sim::Person& person : scenario.people)
      EXPECT_GT(robot.distance_m(person.position_m(t)), 0.7) << "at " << t << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(Data, EachScenario, testing::ValuesIn(scenario_names(kScenarios)),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// How often a person steps onto the ellipse that the robot drives or off it.
int crossings_of(const sim::Scenario& scenario, const sim::Person& person) {
  const auto& path = std::get<sim::Ellipse>(scenario.path);
  const auto inside = [&](double t) {
    const Eigen::Vector2d at = person.position_m(t) - Eigen::Vector2d(path.center_x_m, path.center_y_m);
    return std::hypot(at.x() / path.semi_axis_x_m, at.y() / path.semi_axis_y_m) < 1.0;
  };
  int crossings = 0;
  for (double t = 0.05; t <= scenario.duration_s; t += 0.05)
    crossings += inside(t) != inside(t - 0.05) ? 1 : 0;
  return crossings;
}

TEST(Scenarios, TheEllipseReturnsToItsStartAndThePersonCrossesIt) {
  const sim::Scenario scenario = scenario_of("room-ellipse-people");
  EXPECT_EQ(scenario.path, scenario_of("room-ellipse").path);
  const sim::Drive drive(scenario.path);
  EXPECT_LT(distance_m(drive.map_from_base(0.0), drive.map_from_base(scenario.duration_s)), 1e-9);
  ASSERT_EQ(scenario.people.size(), 1U);
  EXPECT_GE(crossings_of(scenario, scenario.people[0]), 10);
}

TEST(Scenarios, ThreePeopleAreOftenNearAllAtOnce) {
  const sim::Scenario scenario = scenario_of("room-ellipse-three-people");
  EXPECT_EQ(scenario.path, scenario_of("room-ellipse").path);
  ASSERT_EQ(scenario.people.size(), 3U);
  for (const sim::Person& person : scenario.people) EXPECT_GE(crossings_of(scenario, person), 6);
  const sim::Drive drive(scenario.path);
  std::array<std::size_t, 4> sweeps{};
  for (std::size_t i = 0; i < scenario.sweep_count(); ++i) {
    const double t = static_cast<double>(i) / scenario.lidar.rate_hz;
    const Pose2 laser_from_map = (drive.map_from_base(t) * scenario.base_from_laser).inverse();
    std::size_t near = 0;
    for (const sim::Person& person : scenario.people) {
      const Eigen::Vector2d at = laser_from_map * person.position_m(t);
      if (at.norm() < 3.0 && std::abs(std::atan2(at.y(), at.x())) < radians(135.0)) ++near;
    }
    ++sweeps[near];
  }
  // As data/README.md says.
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(scenario.sweep_count());
  };
  EXPECT_NEAR(share(sweeps[3]), 0.37, 0.01);
  EXPECT_NEAR(share(sweeps[3] + sweeps[2]), 0.57, 0.01);
  EXPECT_NEAR(share(sweeps[3] + sweeps[2] + sweeps[1]), 0.77, 0.01);
}

class ReadScenario : public testing::Test {
 protected:
  ReadScenario()
      : directory_(
            std::filesystem::path(testing::TempDir()) /
            ("scenario_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(directory_);
    std::ofstream(directory_ / "plan.yaml") << "walls:\n  - [[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]]\n";
  }
  ~ReadScenario() override { std::filesystem::remove_all(directory_); }

  Result<sim::Scenario> read(const std::string& text) {
    std::ofstream(directory_ / "s.yaml") << text;
    return read_scenario((directory_ / "s.yaml").string());
  }
  /// The message, without the directory.
  std::string refusal(const std::string& text) {
    const auto scenario = read(text);
    if (scenario) return "accepted";
    std::string message = to_string(scenario.error());
    const std::string directory = directory_.string() + "/";
    if (const auto at = message.find(directory); at != std::string::npos) message.erase(at, directory.size());
    return message;
  }

 private:
  std::filesystem::path directory_;
};

TEST_F(ReadScenario, ReadsEveryKey) {
  const auto scenario = read(R"(
description: all of it
plan: plan.yaml
duration_s: 3.5
seed: 9
base_from_laser: [0.5, -0.1, 90]
lidar: {beam_count: 361, range_sigma_m: 0.02, sweep: rotating}
path:
  kind: waypoints
  points: [[1, 1], [2, 1]]
  speed_mps: 0.3
people:
  - {radius_m: 0.3, start_s: 1, waypoints: [[3, 1], [3, 2]]}
  - {waypoints: [[1, 2]]}
)");
  ASSERT_TRUE(scenario) << scenario.error();
  EXPECT_EQ(scenario->name, "s");
  EXPECT_EQ(scenario->description, "all of it");
  EXPECT_EQ(scenario->plan.segments().size(), 4U);
  EXPECT_EQ(scenario->duration_s, 3.5);
  EXPECT_EQ(scenario->seed, 9);
  EXPECT_EQ(scenario->base_from_laser, (Pose2{0.5, -0.1, kPi / 2.0}));
  EXPECT_EQ(scenario->lidar.beam_count, 361);
  EXPECT_EQ(scenario->lidar.range_sigma_m, 0.02);
  EXPECT_EQ(scenario->lidar.range_max_m, sim::LidarConfig{}.range_max_m);
  EXPECT_EQ(scenario->path, sim::Path(sim::Waypoints{.points = {{1, 1}, {2, 1}}, .speed_mps = 0.3}));
  ASSERT_EQ(scenario->people.size(), 2U);
  EXPECT_EQ(scenario->people[0],
            (sim::Person{.radius_m = 0.3, .start_s = 1.0, .waypoints = {{3, 1}, {3, 2}}}));
}

TEST_F(ReadScenario, RefusesInWords) {
  const std::string good = "plan: plan.yaml\npath: {kind: standing, x_m: 1, y_m: 1}\n";
  EXPECT_EQ(refusal(good), "accepted");
  EXPECT_EQ(refusal(good + "sed: 3\n"), "s.yaml:3: a scenario has no key \"sed\" (did you mean \"seed\"?)");
  EXPECT_EQ(refusal(good + "lidar: {beam_cuont: 3}\n"),
            "s.yaml:3: lidar has no key \"beam_cuont\" (did you mean \"beam_count\"?)");
  EXPECT_EQ(refusal(good + "duration_s: -1\n"),
            "s.yaml:3: duration_s: the value \"-1\" is not allowed (allowed: 0 … 86400)");
  EXPECT_EQ(refusal(good + "seed: [1]\n"), "s.yaml:3: seed is a list of 1 (allowed: 0 … 2147483647)");
  EXPECT_EQ(refusal(good + "base_from_laser: [0.7, 0]\n"),
            "s.yaml:3: base_from_laser is a list of 2 (it is [x_m, y_m, theta_deg])");
  EXPECT_EQ(refusal(good + "people: [{waypoints: [[1]]}]\n"),
            "s.yaml:3: a point of waypoints is a list of 1 (waypoints is a list of [x, y] in metres)");
  EXPECT_EQ(refusal(good + "people: [{radius_m: 0.2}]\n"),
            "s.yaml: people.waypoints: are none (a person needs a place to stand)");
  EXPECT_EQ(refusal(good + "lidar: {range_min_m: 30}\n"),
            "s.yaml: lidar.range_max_m: is not above range_min_m (no beam could see anything)");
  EXPECT_EQ(refusal("plan: plan.yaml\n"), "s.yaml: has no path: (it is needed)");
  EXPECT_EQ(refusal("plan: plan.yaml\npath: {kind: flying}\n"),
            "s.yaml:2: kind is \"flying\" (allowed: standing | turning | ellipse | waypoints)");
  EXPECT_EQ(refusal("plan: plan.yaml\npath: {kind: standing, speed_mps: 1}\n"),
            "s.yaml:2: standing path has no key \"speed_mps\" (known: kind, x_m, y_m, heading_deg)");
  EXPECT_THAT(refusal("plan: other.yaml\npath: {kind: standing}\n"), testing::HasSubstr("other.yaml"));
  for (const char* text : {"", "[]", "3", "plan: [", "plan: {}\npath: 3\n", "plan: plan.yaml\npath: []\n",
                           "plan: plan.yaml\npath: {kind: ellipse, semi_axis_x_m: nan}\n"})
    EXPECT_NE(refusal(text), "accepted") << text;
}

TEST_F(ReadScenario, AFileCutShortIsReadOrRefusedButNeverWorse) {
  std::ifstream file(kScenarios + "/room-ellipse-people.yaml");
  std::string whole{std::istreambuf_iterator<char>(file), {}};
  const std::string plan = "../plans/room-emptied.yaml";
  whole.replace(whole.find(plan), plan.size(), "plan.yaml");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto scenario = read(whole.substr(0, length));
    EXPECT_TRUE(scenario.ok() || !scenario.error().what.empty());
  }
}

}  // namespace
}  // namespace beaconless::io
