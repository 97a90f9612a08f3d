// SPDX-License-Identifier: Apache-2.0
// What `beaconless localize` promises to the programs that call it.
#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/scenario_io.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/sim/scenario.hpp"

#include "tests/apps/drive.hpp"
#include "tests/report/well_formed.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::Not;

std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

std::vector<std::string> texts_of(LocalizerConfig config) {
  std::vector<std::string> texts;
  for (const Field& field : fields_of(config)) texts.push_back(field.name + " " + field.text());
  return texts;
}

std::size_t count_of(std::string_view text, std::string_view piece) {
  std::size_t count = 0;
  for (auto at = text.find(piece); at != std::string_view::npos; at = text.find(piece, at + 1)) ++count;
  return count;
}

using Localize = Drive;

TEST_F(Localize, WritesALineForEveryScan) {
  const Ran ran = run(localize() + Words{"--reference", truth(), "--out", folder.path("run")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto trajectory = io::read_tum(folder.path("run/trajectory.tum")).value();
  const auto truths = io::read_tum(truth()).value();
  const auto estimates = io::read_estimates_csv(folder.path("run/estimates.csv")).value();
  ASSERT_EQ(truths.size(), kScans);
  ASSERT_EQ(trajectory.size(), kScans);
  ASSERT_EQ(estimates.size(), kScans);
  for (std::size_t i = 0; i < kScans; ++i) {
    EXPECT_EQ(trajectory[i].stamp, truths[i].stamp);
    EXPECT_EQ(estimates[i].stamp, truths[i].stamp);
    // A TUM file has nine decimals, and the heading's two numbers as many.
    EXPECT_NEAR(trajectory[i].pose.x_m, estimates[i].map_from_base.x_m, 1e-9);
    EXPECT_NEAR(trajectory[i].pose.y_m, estimates[i].map_from_base.y_m, 1e-9);
    EXPECT_NEAR(wrap_angle(trajectory[i].pose.theta_rad - estimates[i].map_from_base.theta_rad), 0.0, 1e-8);
    EXPECT_EQ(estimates[i].status, Status::ok);
  }
  EXPECT_TRUE(folder.read("run/estimates.csv").starts_with(std::string(io::kEstimatesCsvHeader) + "\n"));
  for (const char* name :
       {"trajectory.tum", "estimates.csv", "config.yaml", "report.html", "summary.json", "map.svg"})
    EXPECT_THAT(ran.out, HasSubstr(folder.path("run") + "/" + name + "\n"));
}

TEST_F(Localize, TellsWhyScansWereNotOk) {
  const Ran ran = run(localize() + Words{"--method", "icp-corners", "--set", "feature_icp.min_pairs=1000",
                                         "--out", folder.path("run")});
  EXPECT_EQ(ran.exit_code, 4);
  const auto summary = nlohmann::json::parse(folder.read("run/summary.json"));
  EXPECT_EQ(summary["status_counts"], (nlohmann::json{{"degraded", kScans}}));
  std::size_t told = 0;
  for (const auto& [reason, count] : summary["reason_counts"].items()) {
    EXPECT_TRUE(reason.starts_with("degraded: ")) << reason;
    EXPECT_THAT(ran.out, HasSubstr(reason));
    told += count.get<std::size_t>();
  }
  EXPECT_EQ(told, kScans);
  EXPECT_THAT(ran.err, HasSubstr("icp-corners found no pose itself"));
}

TEST_F(Localize, RefusesOptionsThatWouldChangeNothing) {
  for (const Words& words : {Words{"--method", "icp-full", "--line-fit", "ransac"},
                             Words{"--method", "hector-full", "--loss", "cauchy"},
                             Words{"--method", "icp-full", "--preset", "authors"}}) {
    const Ran ran = run(localize() + words);
    EXPECT_EQ(ran.exit_code, 2) << words[2];
    EXPECT_THAT(ran.err, HasSubstr(words[2] + ": it changes nothing about " + words[1]));
  }
}

TEST_F(Localize, SummaryHasTheKeysThatOthersRead) {
  const Ran ran = run(localize() + Words{"--reference", truth(), "--out", folder.path("run"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto summary = nlohmann::json::parse(folder.read("run/summary.json"));
  EXPECT_EQ(ran.json(), summary);
  EXPECT_EQ(keys_of(summary),
            (std::set<std::string>{"method", "recording", "map", "scans", "status_counts", "reason_counts",
                                   "skipped_records", "update_us", "error", "quality", "protection_m",
                                   "protection_rad", "jumps", "trust"}));
  EXPECT_TRUE(summary["reason_counts"].empty());
  EXPECT_EQ(summary["method"], "walls");
  EXPECT_EQ(summary["scans"], kScans);
  EXPECT_EQ(summary["status_counts"], (nlohmann::json{{"ok", kScans}}));
  EXPECT_EQ(keys_of(summary["update_us"]), (std::set<std::string>{"median", "p99", "max"}));
  EXPECT_GT(summary["update_us"]["median"], 0.0);
  EXPECT_LE(summary["update_us"]["median"], summary["update_us"]["p99"]);
  EXPECT_LE(summary["update_us"]["p99"], summary["update_us"]["max"]);
  EXPECT_EQ(summary["error"]["pairs"], kScans);
  EXPECT_GT(summary["error"]["crb_ratio"]["position"], 0.0);
}

TEST_F(Localize, WithoutAReferenceThereIsNoError) {
  const Ran ran = run(localize() + Words{"--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["scans"], kScans);
  EXPECT_FALSE(ran.json().contains("error"));
}

TEST_F(Localize, ReportIsOneSoundPageThatFetchesNothing) {
  ASSERT_EQ(run(localize() + Words{"--reference", truth(), "--out", folder.path("run")}).exit_code, 0);
  std::string page = folder.read("run/report.html");
  EXPECT_EQ(report::xml_fault(page), "");
  EXPECT_EQ(report::xml_fault(folder.read("run/map.svg")), "");
  const std::string name_of_svg = "xmlns=\"http://www.w3.org/2000/svg\"";  // a name, which nobody fetches
  for (auto at = page.find(name_of_svg); at != std::string::npos; at = page.find(name_of_svg))
    page.erase(at, name_of_svg.size());
  for (const char* word : {"http://", "https://", "<script", "<img", "<link", "url("})
    EXPECT_THAT(page, Not(HasSubstr(word)));
}

TEST_F(Localize, ConfigOfARunMarksWhatIsChangedAndReadsBack) {
  const Ran first = run(localize() + Words{"--sigma", "0.02", "--set", "icp.loss=cauchy", "--set",
                                           "health.lost_after_scans=5", "--out", folder.path("first")});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string text = folder.read("first/config.yaml");
  // These two, the laser's place, and the noise of the six that know of it.
  EXPECT_EQ(count_of(text, "# changed, default "), 9U) << text;
  for (const char* line :
       {"\n  sigma_m: 0.02  # changed, default 0.01;", "\n  x_m: 0.7  # changed, default 0;",
        "\n  loss: cauchy  # changed, default huber;", "\n  lost_after_scans: 5  # changed, default 8;"})
    EXPECT_THAT(text, HasSubstr(line));

  LocalizerConfig expected;
  expected.base_from_laser.x_m = 0.7;
  expected.walls.sigma_m = 0.02;
  expected.icp.sigma_m = 0.02;
  expected.hector.sigma_m = 0.02;
  expected.features.detectors.corners.lines.sigma_m = 0.02;
  expected.features.detectors.falko.sigma_m = 0.02;
  expected.features.detectors.rdp.segmentation.sigma_m = 0.02;
  expected.icp.loss = LossKind::cauchy;
  expected.health.lost_after_scans = 5;
  LocalizerConfig config;
  ASSERT_TRUE(io::read_config(folder.path("first/config.yaml"), fields_of(config)).ok());
  EXPECT_EQ(texts_of(config), texts_of(expected));

  const Ran again = run({"localize", recording(), "--map", plan(), "--start-from", truth(), "--config",
                         folder.path("first/config.yaml"), "--out", folder.path("again")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(folder.read("again/config.yaml"), text);
  EXPECT_EQ(folder.read("again/trajectory.tum"), folder.read("first/trajectory.tum"));
}

TEST_F(Localize, SetCountsMoreThanOptionsAndOptionsMoreThanTheFile) {
  const std::string file = folder.write("c.yaml", "icp: {sigma_m: 0.03, on_map_m: 0.2}\nicp.min_pairs: 20\n");
  const Ran ran = run(localize() + Words{"--config", file, "--sigma", "0.04", "--set", "icp.min_pairs=30",
                                         "--out", folder.path("run")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  LocalizerConfig config;
  ASSERT_TRUE(io::read_config(folder.path("run/config.yaml"), fields_of(config)).ok());
  EXPECT_EQ(config.icp.sigma_m, 0.04);
  EXPECT_EQ(config.icp.on_map_m, 0.2);
  EXPECT_EQ(config.icp.min_pairs, 30);
}

TEST_F(Localize, SetTakesOneWordAndLeavesTheRecording) {
  const Ran ran = run({"localize", "--set", "icp.loss=cauchy", recording(), "--map", plan(),
                       "--base-from-laser", "0.7,0,0", "--start-from", truth()});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST_F(Localize, TheSameCommandGivesTheSameBytes) {
  for (const char* out : {"a", "b"})
    ASSERT_EQ(run(localize() + Words{"--reference", truth(), "--out", folder.path(out)}).exit_code, 0);
  for (const char* name : {"trajectory.tum", "estimates.csv", "config.yaml", "map.svg"}) {
    ASSERT_FALSE(folder.read("a/" + std::string(name)).empty());
    EXPECT_EQ(folder.read("a/" + std::string(name)), folder.read("b/" + std::string(name))) << name;
  }
}

struct Slice {
  const char* words;
  std::vector<std::size_t> first_scans;
  std::size_t count;
};

TEST_F(Localize, TakesTheScansOfTheSlice) {
  const auto truths = io::read_tum(truth()).value();
  for (const Slice& slice :
       {Slice{"1::2", {1, 3, 5}, 20}, Slice{"0:10", {0, 1, 2}, 10}, Slice{":5", {0, 1, 2}, 5},
        Slice{"30:", {30, 31, 32}, 10}, Slice{"7", {7}, 1}, Slice{"2:999:19", {2, 21}, 2}}) {
    const Ran ran = run(localize() + Words{"--scans", slice.words, "--out", folder.path("run")});
    ASSERT_EQ(ran.exit_code, 0) << slice.words << ran.err;
    const auto trajectory = io::read_tum(folder.path("run/trajectory.tum")).value();
    ASSERT_EQ(trajectory.size(), slice.count) << slice.words;
    for (std::size_t i = 0; i < slice.first_scans.size(); ++i)
      EXPECT_EQ(trajectory[i].stamp, truths[slice.first_scans[i]].stamp) << slice.words;
  }
}

/// CARMEN logs of others tell no time per beam; who knows how fast the mirror turns says it.
TEST_F(Localize, ASweepTimeThatIsToldStraightensTheScansOfALog) {
  const std::string scenario = folder.write(
      "fast.yaml",
      "plan: room.yaml\nduration_s: 5\nseed: 6\nlidar: {sweep: rotating, rate_hz: 8}\n"
      "path: {kind: ellipse, center_x_m: 3.2, center_y_m: 2.1, semi_axis_x_m: 1.0, semi_axis_y_m: 0.9, "
      "speed_mps: 1.2, turns: 3}\n");
  ASSERT_EQ(run({"simulate", scenario, "--out", folder.path("fast")}).exit_code, 0);
  io::CarmenWriter silent(folder.path("silent.log"));
  const auto written = sim::simulate(io::read_scenario(scenario).value(), [&](const sim::Sample& sample) {
    RawScan raw = sample.scan;
    raw.time_increment_s = 0.0F;
    silent.write(raw);
  });
  ASSERT_TRUE(written && silent.close());
  const std::string reference = folder.path("fast/truth.tum");
  const Words call{"localize",
                   folder.path("silent.log"),
                   "--map",
                   folder.path("fast/plan.yaml"),
                   "--base-from-laser",
                   "0.7,0,0",
                   "--start-from",
                   reference,
                   "--reference",
                   reference,
                   "--method",
                   "walls",
                   "--out",
                   folder.path("run")};
  const auto rmse_m = [&](const Words& more) {
    const Ran ran = run(call + more);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return nlohmann::json::parse(folder.read("run/summary.json"))["error"]["position_m"]["rmse"]
        .get<double>();
  };
  const double bent_m = rmse_m({});
  const double straight_m = rmse_m({"--sweep-time", "0.09375"});  // 270 of 360 degrees at 8 Hz
  EXPECT_GT(bent_m, 0.01) << "or nothing had to be straightened";
  EXPECT_LT(straight_m, 0.2 * bent_m);
  EXPECT_EQ(rmse_m({"--sweep-time", "0"}), bent_m) << "0: believe the source, which tells none";
  EXPECT_NEAR(rmse_m({"--sweep-time", "0.09375", "--set", "deskew=false"}), bent_m, 0.05 * bent_m);
}

TEST_F(Localize, ASweepTimeThatIsNoTimeIsRefused) {
  for (const char* wrong : {"-0.1", "-1e-9", "nan", "soon", ""}) {
    const Ran ran = run(localize() + Words{"--sweep-time", wrong});
    EXPECT_EQ(ran.exit_code, 2) << wrong;
    EXPECT_THAT(ran.err, HasSubstr("--sweep-time")) << wrong;
  }
}

TEST_F(Localize, SlicesThatTakeNothingAreWrongWords) {
  for (const char* words : {"a:b", "::0", "-3:", "1:2:3:4", "5:2", "4:4", "1.5"}) {
    const Ran ran = run(localize() + Words{"--scans", words});
    EXPECT_EQ(ran.exit_code, 2) << words << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("--scans"));
  }
  const Ran beyond = run(localize() + Words{"--scans", "40:"});
  EXPECT_EQ(beyond.exit_code, 3);
  EXPECT_THAT(beyond.err, HasSubstr("it has 40"));
}

TEST_F(Localize, StartIsGivenOnce) {
  const Words bare{"localize", recording(), "--map", plan(), "--base-from-laser", "0.7,0,0"};
  const auto first = io::read_tum(truth()).value().front().pose;
  const std::string start = std::to_string(first.x_m) + "," + std::to_string(first.y_m) + "," +
                            std::to_string(degrees(first.theta_rad));
  EXPECT_EQ(run(bare).exit_code, 2);
  EXPECT_EQ(run(bare + Words{"--start", start, "--start-from", truth()}).exit_code, 2);
  EXPECT_EQ(run(bare + Words{"--start", start}).exit_code, 0);
  for (const char* wrong : {"1,2", "1,2,3,4", "a,b,c", "nan,0,0", "inf,0,0", ""})
    EXPECT_EQ(run(bare + Words{"--start", wrong}).exit_code, 2) << wrong;
}

TEST_F(Localize, LostAtTheEndIsToldByTheExitCodeAndAllFilesAreThere) {
  const Ran ran = run(localize_on(folder.path("elsewhere.yaml")) +
                      Words{"--reference", truth(), "--out", folder.path("run"), "--json"});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.err, HasSubstr("lost"));
  const auto counts = ran.json()["status_counts"];
  std::size_t sum = 0;
  for (const auto& count : counts) sum += count.get<std::size_t>();
  EXPECT_EQ(sum, kScans);
  EXPECT_GT(counts["lost"], 0U);
  EXPECT_EQ(io::read_tum(folder.path("run/trajectory.tum")).value().size(), kScans);
  EXPECT_EQ(report::xml_fault(folder.read("run/report.html")), "");
}

TEST_F(Localize, AStartFarOutGivesNoNonsense) {
  EXPECT_EQ(run({"localize", recording(), "--map", plan(), "--start", "1e300,-1e300,1e9"}).exit_code, 2);
  const Words far{"localize",
                  recording(),
                  "--map",
                  plan(),
                  "--start",
                  "9e6,-9e6,9e6",
                  "--base-from-laser",
                  "0.7,0,0",
                  "--out",
                  folder.path("run"),
                  "--scans",
                  ":10"};
  EXPECT_EQ(run(far + Words{"--set", "relocalize=false"}).exit_code, 4);
  EXPECT_EQ(run(far).exit_code, 0);  // looked for on the whole map, and found
  for (const char* name : {"trajectory.tum", "estimates.csv", "summary.json"}) {
    EXPECT_THAT(folder.read("run/" + std::string(name)), Not(HasSubstr("nan")));
    EXPECT_THAT(folder.read("run/" + std::string(name)), Not(HasSubstr("inf")));
  }
  const auto estimates = io::read_estimates_csv(folder.path("run/estimates.csv")).value();
  ASSERT_EQ(estimates.size(), 10U);
  const auto truth = io::read_tum(folder.path("sim/truth.tum")).value();
  EXPECT_LT(distance_m(estimates.back().map_from_base, truth.at(estimates.back().stamp).value()), 0.05);
}

TEST_F(Localize, SaysThatItIsNotToldWhereTheLaserSits) {
  const Words bare{"localize", recording(), "--map", plan(), "--start-from", truth()};
  EXPECT_THAT(run(bare).err, HasSubstr("where the laser sits on the robot is not told"));
  for (const Words& told : {Words{"--base-from-laser", "0,0,0"}, Words{"--set", "base_from_laser.x_m=0.7"}})
    EXPECT_THAT(run(bare + told).err, Not(HasSubstr("is not told")));
}

TEST_F(Localize, AFolderThatStaysEmptyIsNotLeftBehind) {
  const Words bad{"localize", folder.path("missing.bag"), "--map", plan(), "--start", "auto"};
  EXPECT_EQ(run(bad + Words{"--out", folder.path("run")}).exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder.path("run")));
  std::filesystem::create_directory(folder.path("mine"));
  EXPECT_EQ(run(bad + Words{"--out", folder.path("mine")}).exit_code, 3);
  EXPECT_TRUE(std::filesystem::exists(folder.path("mine")));
}

TEST_F(Localize, AFolderThatCannotBeMadeIsToldBeforeTheWork) {
  const Ran ran = run(localize() + Words{"--out", folder.path("drive.yaml")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, HasSubstr(folder.path("drive.yaml")));
}

TEST_F(Localize, LinesOfAReferenceThatAreNoPoseAreNamed) {
  const std::string reference = folder.write("ref.tum", folder.read("sim/truth.tum") + "half a li");
  const Ran ran = run(localize() + Words{"--reference", reference});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_THAT(ran.err, HasSubstr(reference + ":41:"));
  // One file for both is told once.
  const Ran both = run({"localize", recording(), "--map", plan(), "--base-from-laser", "0.7,0,0",
                        "--start-from", reference, "--reference", reference});
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_EQ(count_of(both.err, reference + ":41:"), 1U) << both.err;
}

}  // namespace
}  // namespace beaconless
