// SPDX-License-Identifier: Apache-2.0
// `beaconless features`: what it writes, draws and says, and what it refuses.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/features/detector.hpp"
#include "beaconless/io/recording.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

class FeaturesVerb : public Drive {
 protected:
  std::string content(const std::string& name) const {
    std::ifstream in(folder.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Words features(const Words& more) const { return Words{"features", recording()} + more; }
};

TEST_F(FeaturesVerb, WritesWhatTheLibraryFinds) {
  const Ran ran =
      run(features({"--detector", "corners,falko,oc,flirt-blob,flirt-edge,flirt-range,flirt-curvature",
                    "--csv", folder.path("all.csv"), "--scans", "0::10"}));
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::istringstream csv(content("all.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  EXPECT_EQ(line, "scan,detector,beam,x_m,y_m,orientation_rad,scale_m,score");

  std::size_t index = 0;
  std::size_t rows = 0;
  for (const Event& event : io::open_recording(recording()).value()) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr || index++ % 10 != 0) continue;
    for (const Detector detector : {Detector::corners, Detector::falko, Detector::oc, Detector::flirt_blob,
                                    Detector::flirt_edge, Detector::flirt_range, Detector::flirt_curvature}) {
      for (const Keypoint& keypoint : detect(*scan, detector)) {
        ASSERT_TRUE(std::getline(csv, line));
        const auto words = split_words(line, ",");
        ASSERT_EQ(words.size(), 8U) << line;
        EXPECT_EQ(words[0], std::to_string(index - 1));
        EXPECT_EQ(words[1], to_string(detector));
        EXPECT_EQ(words[2], std::to_string(keypoint.beam));
        EXPECT_NEAR(parse_double(words[3]).value(), keypoint.point.x(), 1e-6);
        EXPECT_NEAR(parse_double(words[4]).value(), keypoint.point.y(), 1e-6);
        EXPECT_NEAR(parse_double(words[5]).value(), keypoint.orientation_rad, 1e-6);
        EXPECT_NEAR(parse_double(words[6]).value(), keypoint.scale_m, 1e-6);
        EXPECT_NEAR(parse_double(words[7]).value(), keypoint.score, 1e-6 * std::max(1.0, keypoint.score));
        ++rows;
      }
    }
  }
  EXPECT_FALSE(std::getline(csv, line)) << line;
  EXPECT_GT(rows, 4U * 10U);
}

TEST_F(FeaturesVerb, DrawsTheScanThatIsAskedFor) {
  const std::string svg = folder.path("scan.svg");
  ASSERT_EQ(run(features({"--detector", "corners,falko", "--scan", "7", "--plot", svg})).exit_code, 0);
  const std::string drawn = content("scan.svg");
  EXPECT_THAT(drawn, HasSubstr("scan 7: corners"));
  EXPECT_THAT(drawn, HasSubstr("scan 7: falko"));
  EXPECT_THAT(drawn, HasSubstr("1081 beams that hit something"));
  EXPECT_THAT(drawn, testing::EndsWith("</svg>\n"));
  ASSERT_EQ(run(features({"--sweep", "threshold", "--plot", svg})).exit_code, 0);
  for (const char* figure : {"Figure 4.5", "Figure 4.6", "Figure 4.7", "Figure 4.8", "Figure 4.9"})
    EXPECT_THAT(content("scan.svg"), HasSubstr(figure));
}

TEST_F(FeaturesVerb, TellsHowWellKeypointsAreFoundAgain) {
  const auto told = run(features({"--detector", "corners,oc", "--reference", truth(), "--base-from-laser",
                                  "0.7,0,0", "--gap", "5", "--json"}))
                        .json();
  ASSERT_EQ(told["scans"], kScans);
  ASSERT_EQ(told["detectors"].size(), 2U);
  for (const auto& of : told["detectors"]) {
    EXPECT_GT(of["per_scan"], 1.0);
    EXPECT_GT(of["repeatability"]["found_ratio"], 0.9) << of;
    EXPECT_LT(of["repeatability"]["mean_distance_m"], 0.01) << of;
  }
  const auto wrong =
      run(features({"--detector", "corners", "--reference", truth(), "--gap", "5", "--json"})).json();
  EXPECT_GT(wrong["detectors"][0]["repeatability"]["mean_distance_m"],
            told["detectors"][0]["repeatability"]["mean_distance_m"])
      << "without where the laser sits on the robot";
}

TEST_F(FeaturesVerb, TakesParametersByNameAndByPreset) {
  const auto keypoints = [&](const Words& more) {
    return run(features(Words{"--detector", "falko", "--json"} + more))
        .json()["detectors"][0]["keypoints"]
        .get<int>();
  };
  const int ours = keypoints({});
  EXPECT_EQ(keypoints({"--set", "falko.range_max_m=0.2"}), 0);
  EXPECT_NE(keypoints({"--preset", "dissertation"}), ours);
  EXPECT_EQ(keypoints({"--preset", "beaconless"}), ours);
}

TEST_F(FeaturesVerb, RefusesWhatItDoesNotKnow) {
  const auto refused = [&](const Words& more, const std::string& what) {
    const Ran ran = run(features(more));
    EXPECT_EQ(ran.exit_code, 2) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(what));
  };
  refused({"--detector", "falco"}, "did you mean \"falko\"");
  refused({"--set", "falko.radius.at_zer_m=1"}, "falko.radius.at_zero_m");
  refused({"--set", "falko.sectors=1000"}, "4 … 64");
  refused({"--sweep", "threshold"}, "--plot");
  refused({"--scan", "4000", "--plot", folder.path("no.svg")}, "--scan 4000");
  refused({"--csv", recording()}, "written over");
  refused({"--csv", folder.path("one"), "--plot", folder.path("one")}, "the same file");
  refused({"--gap", "0"}, "--gap");
  EXPECT_EQ(run(features({"--csv", folder.path("no/such/folder.csv")})).exit_code, 3);
  EXPECT_EQ(run({"features", folder.path("nothing.log")}).exit_code, 3);
}

TEST_F(FeaturesVerb, ReferenceOfItsParametersIsUpToDate) {
  std::ifstream in(BEACONLESS_SOURCE_DIR "/docs/reference/feature-parameters.md", std::ios::binary);
  ASSERT_TRUE(in.good());
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string table = run({"params", "--features", "--markdown"}).out;
  EXPECT_THAT(table, HasSubstr("| `falko.radius.at_zero_m` |"));
  EXPECT_THAT(page, HasSubstr(table)) << "put the output of `beaconless params --features --markdown` there";
}

}  // namespace
}  // namespace beaconless
