// SPDX-License-Identifier: Apache-2.0
// `beaconless localize` and `map build` with the scans of two lasers.
#include <gmock/gmock.h>

#include "beaconless/io/mcap_events.hpp"
#include "beaconless/io/raw_from.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/sim/scenario.hpp"

#include "tests/apps/drive.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

/// Two lasers on a robot that drives through a room, in one MCAP file.
class SeveralLasers : public Program {
 protected:
  void SetUp() override {
    folder.write("room.yaml", kNicheRoom);
    write_drive(drive(), "rear");
  }

  std::string drive() const { return folder.path("drive.mcap"); }
  std::string truth() const { return folder.path("truth.tum"); }

  /// The rear laser's scans have a frame that may be that of the other.
  void write_drive(const std::string& path, const std::string& rear_frame) const {
    const std::vector<std::pair<std::string, Pose2>> lasers{{"front", {0.5, 0.0, 0.0}},
                                                            {rear_frame, {-0.5, 0.0, kPi}}};
    std::vector<sim::SimulatedRun> runs;
    for (const auto& [frame, place] : lasers) {
      sim::Scenario scenario;
      scenario.plan = test::niche_room();
      scenario.path = sim::Waypoints{.points = {{2.0, 1.5}, {4.0, 2.0}}, .speed_mps = 1.0};
      scenario.lidar = {.beam_count = 361, .angle_min_deg = -90.0, .angle_max_deg = 90.0, .rate_hz = 10.0};
      scenario.lidar.sweep = sim::Sweep::instantaneous;  // maps are drawn as if it were
      scenario.duration_s = 2.0;
      scenario.base_from_laser = place;
      scenario.seed = static_cast<int>(runs.size()) + 1;
      runs.push_back(sim::simulate(scenario).value());
    }
    io::McapEventWriter out(path);
    io::TumWriter poses(truth());
    for (std::size_t i = 0; i < runs[0].events.size(); ++i) {
      poses.write(runs[0].truth[i].stamp, runs[0].truth[i].pose);
      for (std::size_t k = 0; k < lasers.size(); ++k) {
        RawScan raw = io::raw_from(std::get<Scan>(runs[k].events[i]));
        raw.frame_id = lasers[k].first;
        out.place_laser(lasers[k].second);
        out.write(raw, k == 0 ? "/front" : "/rear");
      }
    }
    ASSERT_TRUE(out.finish());
    ASSERT_TRUE(poses.finish());
  }

  Words localize(const Words& more) const {
    return Words{"--json",       "localize", drive(),       "--map", folder.path("room.yaml"),
                 "--start-from", truth(),    "--reference", truth()} +
           more;
  }
};

TEST_F(SeveralLasers, AreLocalizedTogether) {
  const Ran ran = run(localize({"--topic", "/front", "--topic", "/rear"}));
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["status_counts"]["ok"], 40);
  // The file's /tf_static places each of them: nearer than one alone can be.
  const Ran front = run(localize({"--topic", "/front"}));
  EXPECT_LT(ran.json()["error"]["position_m"]["rmse"], front.json()["error"]["position_m"]["rmse"]);
  EXPECT_LT(ran.json()["error"]["position_m"]["max"], 0.02);
}

/// The file tells by /tf_static where they sit; who tells otherwise is believed, in the order of the topics.
TEST_F(SeveralLasers, SitWhereTheWordsSay) {
  const Ran right = run(localize({"--topic", "/rear", "--topic", "/front", "--base-from-laser=-0.5,0,180",
                                  "--base-from-laser", "0.5,0,0"}));
  ASSERT_EQ(right.exit_code, 0) << right.err;
  EXPECT_LT(right.json()["error"]["position_m"]["max"], 0.02);
  const Ran swapped = run(localize({"--topic", "/front", "--topic", "/rear", "--base-from-laser=-0.5,0,180",
                                    "--base-from-laser", "0.5,0,0"}));
  EXPECT_GT(swapped.json()["error"]["position_m"]["max"], 0.5);
}

TEST_F(SeveralLasers, AreWrittenForViewersUnderTheirOwnTopicsAndAtTheirPlaces) {
  const Ran ran =
      run(localize({"--topic", "/front", "--topic", "/rear", "--out-mcap", folder.path("run.mcap")}));
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const auto& [topic, x_m] : {std::pair{"/front", 0.5}, {"/rear", -0.5}}) {
    const auto written = io::open_recording(folder.path("run.mcap"), {.topic = topic});
    ASSERT_TRUE(written) << to_string(written.error());
    ASSERT_TRUE(written->laser_place());
    EXPECT_EQ(written->laser_place()->base_from_laser.x_m, x_m);
  }
}

TEST_F(SeveralLasers, GoIntoACopyUnderTheirOwnTopicsAndAtTheirPlaces) {
  std::vector<std::string> names{"copy.mcap", "copy.db3"};
#ifdef BEACONLESS_HAS_ROSBAG1
  names.emplace_back("copy.bag");
#endif
  const auto scans_of = [](const std::string& path, const std::string& topic) {
    std::vector<Scan> scans;
    for (const Event& event : io::open_recording(path, {.topic = topic}).value())
      if (const auto* scan = std::get_if<Scan>(&event)) scans.push_back(*scan);
    return scans;
  };
  for (const std::string& name : names) {
    const Ran ran =
        run({"--json", "convert", drive(), folder.path(name), "--topic", "/front", "--topic", "/rear"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["scans"], 40);
    for (const auto& [topic, x_m] : {std::pair{"/front", 0.5}, {"/rear", -0.5}}) {
      EXPECT_EQ(scans_of(folder.path(name), topic), scans_of(drive(), topic)) << name << topic;
      const auto place = io::open_recording(folder.path(name), {.topic = topic}).value().laser_place();
      ASSERT_TRUE(place) << name << topic;
      EXPECT_EQ(place->base_from_laser.x_m, x_m);
    }
  }
  const Ran some = run({"--json", "convert", drive(), folder.path("some.mcap"), "--topic", "/front",
                        "--topic", "/rear", "--scans", "::2"});
  EXPECT_EQ(some.json()["scans"], 20) << "every other one of each";
  const Ran log = run({"convert", drive(), folder.path("copy.log"), "--topic", "/front", "--topic", "/rear"});
  EXPECT_NE(log.exit_code, 0);
  EXPECT_THAT(log.err, HasSubstr("one laser"));
}

/// One that nobody places stays so, and what the drive tells besides its scans is told once.
TEST_F(SeveralLasers, ALaserWithoutAPlaceDoesNotGetThatOfAnother) {
  const std::string from = folder.path("half.mcap");
  {
    io::McapEventWriter out(from);
    RawScan raw{.angle_increment_rad = 0.1F, .range_max_m = 10.0F, .ranges_m = {1.0F, 2.0F}};
    for (std::int64_t i = 1; i <= 3; ++i) {
      raw.stamp = {i * 1'000'000'000};
      raw.frame_id = "bare";  // written before there is any place
      out.write(raw, "/bare");
    }
    out.place_laser({0.5, 0.0, 0.0});
    for (std::int64_t i = 1; i <= 3; ++i) {
      raw.stamp = {i * 1'000'000'000 + 1};
      raw.frame_id = "front";
      out.write(raw, "/front");
    }
    ASSERT_TRUE(out.finish());
  }
  const std::string to = folder.path("copy.mcap");
  ASSERT_EQ(run({"convert", from, to, "--topic", "/front", "--topic", "/bare"}).exit_code, 0);
  EXPECT_TRUE(io::open_recording(to, {.topic = "/front"}).value().laser_place());
  EXPECT_FALSE(io::open_recording(to, {.topic = "/bare"}).value().laser_place());
  EXPECT_EQ(run({"--json", "info", to}).json()["problems"].size(), 0U);
  const std::string bytes = folder.read("copy.mcap");
  folder.write("cut.mcap", bytes.substr(0, bytes.size() - 40));
  EXPECT_EQ(run({"--json", "info", folder.path("cut.mcap")}).json()["problems"].size(), 1U);
  const Ran cut = run({"info", folder.path("cut.mcap")});
  EXPECT_THAT(cut.err, HasSubstr("warning: " + folder.path("cut.mcap")));
  const Ran twice = run({"convert", from, to, "--topic", "/front", "--topic", "front"});
  EXPECT_THAT(twice.err, HasSubstr("/front is named twice"));
}

TEST_F(SeveralLasers, AreExaminedOneAfterTheOther) {
  const Ran ran = run({"doctor", drive()});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.out, testing::AllOf(HasSubstr("/front:\n"), HasSubstr("/rear:\n"),
                                      testing::Not(HasSubstr("no scans"))));
  EXPECT_EQ(run({"--json", "doctor", drive()}).json()["topics"].size(), 2U);
}

TEST_F(SeveralLasers, AreInTheFilesOfTheRun) {
  const Ran ran = run(localize({"--topic", "/front", "--topic", "/rear", "--out", folder.path("run")}));
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto lasers = ran.json()["lasers"];
  ASSERT_EQ(lasers.size(), 2U);
  EXPECT_EQ(lasers[1]["frame_id"], "rear");
  EXPECT_EQ(lasers[1]["base_from_laser"][0], -0.5);
  EXPECT_THAT(folder.read("run/config.yaml"), HasSubstr("#   \"rear\": -0.5,0,"));
  const Ran again =
      run(localize({"--topic", "/front", "--topic", "/rear", "--config", folder.path("run/config.yaml")}));
  EXPECT_EQ(again.json()["error"], ran.json()["error"]);
}

TEST_F(SeveralLasers, DrawOneMap) {
  const Ran ran = run({"--json", "map", "build", drive(), "--topic", "/front", "--topic", "/rear", "--poses",
                       truth(), "--out", folder.path("both.yaml")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["scans"], 40);
  const Ran localized = run({"--json", "localize", drive(), "--map", folder.path("both.yaml"), "--topic",
                             "/rear", "--start-from", truth(), "--reference", truth()});
  ASSERT_EQ(localized.exit_code, 0) << localized.err;
  EXPECT_LT(localized.json()["error"]["position_m"]["max"], 0.1);
}

TEST_F(SeveralLasers, AreRefusedWhereTheyCannotBeToldApartOrPlaced) {
  const Ran missing = run(localize({"--topic", "/front", "--topic", "/rear", "--base-from-laser", "0,0,0"}));
  EXPECT_NE(missing.exit_code, 0);
  EXPECT_THAT(missing.err, HasSubstr("2 lasers and 1 places"));
  const Ran slam = run({"map", "build", drive(), "--slam", "hector", "--topic", "/front", "--topic", "/rear",
                        "--out", folder.path("slam.yaml")});
  EXPECT_EQ(slam.exit_code, 2);
  EXPECT_THAT(slam.err, HasSubstr("one laser"));
  const Ran kept = run(localize({"--topic", "/front", "--topic", "/rear", "--blackbox", folder.path("box")}));
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_THAT(kept.err, HasSubstr("one laser"));
  write_drive(drive(), "front");
  const Ran alike = run(localize({"--topic", "/front", "--topic", "/rear"}));
  EXPECT_NE(alike.exit_code, 0);
  EXPECT_THAT(alike.err, HasSubstr("\"front\""));
}

}  // namespace
}  // namespace beaconless
