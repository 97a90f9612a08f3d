// SPDX-License-Identifier: Apache-2.0
// Files that cannot be used: exit code 3, and a message with the path and the reason.
#include <functional>

#include <gmock/gmock.h>

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr long kFairMemory_kb = 500'000;  // four billion floats would be 16 GB

/// A verb with one of its path arguments.
struct PathArgument {
  const char* name;
  std::function<Words(const std::string& path)> call;
  bool may_be_empty = false;
};

class BadFiles : public Drive {
 protected:
  void SetUp() override {
    Drive::SetUp();
    ASSERT_EQ(run(localize() + Words{"--out", folder.path("run")}).exit_code, 0);
  }

  std::vector<PathArgument> path_arguments() const {
    const std::string trajectory = folder.path("run/trajectory.tum");
    const std::string out = folder.path("out.yaml");
    const Words evaluate{"evaluate", trajectory, truth()};
    const Words on_plan{"--map", plan(), "--base-from-laser", "0.7,0,0"};
    using Path = const std::string&;
    return {{"recording",
             [=](Path p) {
               return Words{"localize", p, "--start", "3,1.4,0"} + on_plan;
             }},
            {"map", [=, this](Path p) { return localize_on(p); }},
            {"start",
             [=, this](Path p) {
               return Words{"localize", recording(), "--start-from", p} + on_plan;
             }},
            {"reference",
             [=, this](Path p) {
               return localize() + Words{"--reference", p};
             }},
            {"config",
             [=, this](Path p) {
               return localize() + Words{"--config", p};
             },
             true},
            {"estimate",
             [=, this](Path p) {
               return Words{"evaluate", p, truth()};
             }},
            {"estimate.csv",
             [=, this](Path p) {
               return Words{"evaluate", p + ".csv", truth()};
             }},
            {"reference of evaluate",
             [=](Path p) {
               return Words{"evaluate", trajectory, p};
             }},
            {"map of evaluate",
             [=](Path p) {
               return evaluate + Words{"--map", p};
             }},
            {"recording of evaluate",
             [=, this](Path p) {
               return evaluate + Words{"--map", plan(), "--recording", p};
             }},
            {"recording of map build",
             [=, this](Path p) { return Words{"map", "build", p, "--poses", truth(), "--out", out}; }},
            {"poses of map build",
             [=, this](Path p) { return Words{"map", "build", recording(), "--poses", p, "--out", out}; }},
            {"recording of poses",
             [=](Path p) {
               return Words{"poses", p, "--out", out};
             }},
            {"info",
             [](Path p) {
               return Words{"info", p};
             }},
            {"info.yaml",
             [](Path p) {
               return Words{"info", p + ".yaml"};
             }},
            {"doctor",
             [](Path p) {
               return Words{"doctor", p};
             }},
            {"scenario", [=, this](Path p) {
               return Words{"simulate", p + ".yaml", "--out", folder.path("simulated")};
             }}};
  }

  void expect_refused(const PathArgument& argument, const std::string& path) const {
    const Ran ran = run(argument.call(path) + Words{"--json"});
    EXPECT_EQ(ran.exit_code, 3) << argument.name << "\n" << testing::PrintToString(ran);
    EXPECT_EQ(ran.out, "") << argument.name;
    const auto at = ran.err.find(path);
    ASSERT_NE(at, std::string::npos) << argument.name << "\n" << ran.err;
    EXPECT_GT(ran.err.size(), at + path.size() + std::string(": no.\n").size()) << argument.name << ran.err;
  }

  /// The same bytes under each ending that an argument may add.
  std::string write_all(const std::string& name, std::string_view bytes) const {
    for (const char* ending : {".csv", ".yaml"}) folder.write(name + ending, bytes);
    return folder.write(name, bytes);
  }
};

TEST_F(BadFiles, MissingFiles) {
  for (const auto& argument : path_arguments()) expect_refused(argument, folder.path("nowhere"));
}

TEST_F(BadFiles, Folders) {
  for (const char* name : {"folder", "folder.csv", "folder.yaml"})
    std::filesystem::create_directory(folder.path(name));
  for (const auto& argument : path_arguments()) expect_refused(argument, folder.path("folder"));
}

TEST_F(BadFiles, EmptyFiles) {
  const std::string path = write_all("empty", "");
  for (const auto& argument : path_arguments())
    if (!argument.may_be_empty) expect_refused(argument, path);
}

TEST_F(BadFiles, BinaryFiles) {
  std::string bytes;
  for (unsigned i = 0; i < 5000; ++i) bytes += static_cast<char>((i * 2654435761U) >> 13U);
  const std::string path = write_all("binary", bytes);
  for (const auto& argument : path_arguments()) expect_refused(argument, path);
}

TEST_F(BadFiles, TextOfAnotherKind) {
  const std::string path = write_all("letter", "Dear robot,\nthe key is under the mat.\n");
  for (const auto& argument : path_arguments()) expect_refused(argument, path);
}

TEST_F(BadFiles, OneKindForAnother) {
  const std::string out = folder.path("o.yaml");
  for (const Words& words :
       std::vector<Words>{{"localize", plan(), "--map", plan(), "--start", "0,0,0"},
                          {"localize", truth(), "--map", plan(), "--start", "0,0,0"},
                          localize_on(truth()),
                          localize_on(recording()),
                          localize_on(folder.path("drive.yaml")),
                          localize() + Words{"--reference", recording()},
                          {"evaluate", plan(), truth()},
                          {"evaluate", folder.path("run/estimates.csv"), folder.path("run/estimates.csv")},
                          {"simulate", plan(), "--out", folder.path("simulated")},
                          {"info", truth()}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 3) << testing::PrintToString(words) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(folder.path("")));
  }
}

TEST_F(BadFiles, ACutRecordingGivesWhatIsLeftOfIt) {
  const std::string whole = folder.read("sim/recording.log.gz");
  std::size_t most = 0;
  for (const std::size_t share : {1, 3, 10, 40, 70, 90, 99}) {
    const std::string cut = folder.write("cut.log.gz", whole.substr(0, whole.size() * share / 100));
    const Ran ran = run({"localize", cut, "--map", plan(), "--base-from-laser", "0.7,0,0", "--start-from",
                         truth(), "--json"});
    EXPECT_THAT(ran.exit_code, AnyOf(0, 3)) << share << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(cut));
    if (ran.exit_code != 0) continue;
    EXPECT_THAT(ran.err, HasSubstr("end early"));
    const auto scans = ran.json()["scans"].get<std::size_t>();
    EXPECT_GE(scans, most);
    most = scans;
  }
  EXPECT_GT(most, 30U);
  EXPECT_LT(most, kScans);
}

TEST_F(BadFiles, CutMapsAreRefused) {
  const std::string yaml = folder.write("g.yaml", "image: g.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n");
  const std::string whole = "P5\n4 3\n255\n" + std::string(12, '\x01');
  for (std::size_t size = 0; size < whole.size(); ++size) {
    folder.write("g.pgm", whole.substr(0, size));
    const Ran ran = run(localize_on(yaml));
    EXPECT_EQ(ran.exit_code, 3) << size << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(folder.path("g.pgm")));
  }
  const std::string walls = folder.read("room.yaml");
  for (std::size_t size = 0; size < walls.size(); size += 7)
    EXPECT_THAT(run({"info", folder.write("cut.yaml", walls.substr(0, size))}).exit_code, AnyOf(0, 3))
        << size;
}

TEST_F(BadFiles, PromisesOfFourBillionAreNotBelieved) {
  const std::string tail = " 1 1 1 0 0 0 0 0 0 1 r 1\n";
  for (const std::string& line :
       {"FLASER 4000000000" + tail, "FLASER 4294967295" + tail, "FLASER 99999999999999999999" + tail,
        "RAWLASER1 0 -1.57 3.14 0.0000000001 81 0.01 0 4000000000" + tail,
        "ROBOTLASER1 0 -1.57 3.14 0.0000000001 81 0.01 0 4000000000" + tail}) {
    const std::string log = folder.write("hostile.log", line);
    const Ran ran = run({"localize", log, "--map", plan(), "--start", "3,1.4,0"});
    EXPECT_EQ(ran.exit_code, 3) << line << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(log + ":1:")) << line;
    EXPECT_LT(ran.peak_memory_kb, kFairMemory_kb) << line;
  }
  const std::string yaml = folder.write("g.yaml", "image: g.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n");
  for (const char* head :
       {"P5\n4000000000 1\n255\n", "P5\n60000 60000\n255\n", "P2\n60000 60000\n255\n1 2 3"}) {
    folder.write("g.pgm", head);
    const Ran ran = run({"info", yaml});
    EXPECT_EQ(ran.exit_code, 3) << head << ran.err;
    EXPECT_LT(ran.peak_memory_kb, kFairMemory_kb) << head;
  }
}

TEST_F(BadFiles, ABadLineAmongGoodOnesIsNamedAndCounted) {
  std::string log;
  for (int i = 0; i < 10; ++i) {
    if (i == 4) log += "FLASER 4000000000 1 2 3\n";
    std::string beams;
    for (int beam = 0; beam < 180; ++beam) beams += " 1";
    const std::string t = std::to_string(i);
    log += "FLASER 180" + beams + " 0 0 0 0 0 0 " + t + " r " + t + "\n";
  }
  const std::string path = folder.write("hurt.log", log);
  const Ran ran = run({"localize", path, "--map", plan(), "--start", "3,1.4,0", "--json"});
  EXPECT_EQ(ran.json()["scans"], 10U) << ran.err;
  EXPECT_EQ(ran.json()["skipped_records"], 1U);
  EXPECT_THAT(ran.err, HasSubstr(path + ":5:"));
}

TEST_F(BadFiles, OldBagsAreRefusedByName) {
  const std::string bag = folder.write("old.bag", "#ROSBAG V1.2\n" + std::string(4096, '\0'));
  const Ran ran = run({"info", bag});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr(bag));
  EXPECT_THAT(ran.err, AnyOf(HasSubstr("V1.2"), HasSubstr("without reading them")));
}

TEST_F(BadFiles, MapsWithoutWallsAreRefusedByTheirName) {
  const std::string point = folder.write("point.yaml", "walls:\n  - [[1, 1], [1, 1]]\n");
  folder.write("white.pgm", "P5\n2 2\n255\n\xfe\xfe\xfe\xfe");
  const std::string white =
      folder.write("white.yaml", "image: white.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n");
  for (const std::string& map : {point, white}) {
    const Ran ran = run(localize_on(map));
    EXPECT_EQ(ran.exit_code, 3) << map;
    EXPECT_THAT(ran.err, HasSubstr(map + ": "));
  }
}

TEST_F(BadFiles, PosesOutOfThisWorldMakeNoMap) {
  const std::string far = folder.write("far.tum", "0 1e8 1e8 0 0 0 0 1\n1 1e8 1e8 0 0 0 0 1\n");
  const Ran ran = run({"map", "build", recording(), "--poses", far, "--out", folder.path("m.yaml")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr(recording() + ": scan 0"));
  EXPECT_LT(ran.peak_memory_kb, kFairMemory_kb);
}

TEST_F(BadFiles, PlacesThatCannotBeWritten) {
  const std::string log = folder.write("p.log", "ODOM 1 2 0.5 0 0 0 1.0 robot 1.0\n");
  const std::string inside_a_file = folder.path("drive.yaml") + "/x";
  for (const Words& words :
       std::vector<Words>{localize() + Words{"--out", inside_a_file},
                          {"simulate", "small-static", "--out", inside_a_file},
                          {"poses", log, "--out", inside_a_file},
                          {"map", "build", recording(), "--poses", truth(), "--out", inside_a_file + ".yaml"},
                          {"map", "build", recording(), "--poses", truth(), "--out", folder.path("map.txt")},
                          {"demo", "--out", inside_a_file}}) {
    const Ran ran = run(words + Words{"--json"});
    EXPECT_EQ(ran.exit_code, 3) << words.front() << ran.err;
    EXPECT_EQ(ran.out, "") << words.front();
    EXPECT_THAT(ran.err, HasSubstr(folder.path(""))) << words.front();
  }
}

TEST_F(BadFiles, AnUnknownTopicListsThoseThatAreThere) {
  const Ran ran = run(localize() + Words{"--topic", "FLASER"});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr("RAWLASER1"));
}

}  // namespace
}  // namespace beaconless
