// SPDX-License-Identifier: Apache-2.0
// What the detectors are measured by: how well their keypoints are found again in rooms that an independent
// program simulated, and the keypoints that the public libraries found there.
#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/features/falko.hpp"
#include "beaconless/io/recording.hpp"

#include "tests/apps/program.hpp"

namespace beaconless {
namespace {

/// Least share found again ten scans later within 0.1 m, least keypoints a scan, greatest mean distance.
struct Again {
  const char* detector;
  double found_ratio;
  double per_scan;
  double mean_m;
};

void PrintTo(const Again& again, std::ostream* out) { *out << again.detector; }

class FoundAgain : public Program, public testing::WithParamInterface<Again> {};

TEST_P(FoundAgain, OnB1) {
  const std::string log = recorded("sim_rooms/b1_ellipse.carmen.log.gz");
  if (log.empty()) GTEST_SKIP() << "sim_rooms is not here; BEACONLESS_DATA names its folder";
  const auto told = run({"features", log, "--detector", GetParam().detector, "--reference",
                         recorded("sim_rooms/b1_ellipse.truth.tum"), "--gap", "10", "--json"})
                        .json();
  ASSERT_TRUE(told.contains("detectors"));
  const auto of = told["detectors"][0];
  EXPECT_GE(of["repeatability"]["found_ratio"], GetParam().found_ratio) << of;
  EXPECT_GE(of["repeatability"]["matched_ratio"], GetParam().found_ratio) << of;
  EXPECT_GE(of["per_scan"], GetParam().per_scan) << of;
  EXPECT_LE(of["repeatability"]["mean_distance_m"], GetParam().mean_m) << of;
}

INSTANTIATE_TEST_SUITE_P(Detectors, FoundAgain,
                         testing::Values(Again{"corners", 0.92, 7.0, 0.0055},
                                         Again{"falko", 0.85, 9.0, 0.012}, Again{"oc", 0.85, 7.0, 0.005},
                                         Again{"flirt-range", 0.75, 23.0, 0.03},
                                         Again{"flirt-blob", 0.65, 45.0, 0.04},
                                         Again{"flirt-edge", 0.78, 23.0, 0.03},
                                         Again{"flirt-curvature", 0.75, 38.0, 0.04}),
                         [](const auto& of) {
                           std::string name = of.param.detector;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

/// Keypoints of falkolib by scan, from the list of witnesses.
using Witnesses = std::map<std::size_t, std::vector<Eigen::Vector2d>>;

Witnesses witnesses_of(const std::string& path, const std::string& sequence, const std::string& detector) {
  Witnesses witnesses;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const auto words = split_words(line, ",");
    if (words.size() != 8 || words[0] != sequence || words[1] != detector) continue;
    witnesses[static_cast<std::size_t>(parse_double(words[2]).value())].emplace_back(
        parse_double(words[4]).value(), parse_double(words[5]).value());
  }
  return witnesses;
}

/// Of a library's keypoints, the share that ours finds within 3 cm with the library's parameters.
TEST_F(Program, FalkoFindsWhatFalkolibFinds) {
  const std::string path = recorded("oracles/keypoints.csv");
  if (path.empty()) GTEST_SKIP() << "oracles is not here; BEACONLESS_DATA names its folder";
  const FalkoConfig authors = falko_preset("authors").value();
  for (const char* sequence : {"a1_static", "b1_ellipse"}) {
    const auto recording =
        io::open_recording(recorded("sim_rooms/" + std::string(sequence) + ".carmen.log.gz")).value();
    for (const char* detector : {"falko", "falko_circular_fix"}) {
      const Witnesses witnesses = witnesses_of(path, sequence, detector);
      ASSERT_GT(witnesses.size(), 9U);
      std::size_t index = 0;
      std::size_t count = 0;
      std::size_t found = 0;
      for (const Event& event : recording) {
        const auto* scan = std::get_if<Scan>(&event);
        if (scan == nullptr) continue;
        const auto at = witnesses.find(index++);
        if (at == witnesses.end()) continue;
        const auto keypoints = detect_falko(*scan, authors);
        for (const Eigen::Vector2d& witness : at->second) {
          ++count;
          found += std::ranges::any_of(keypoints,
                                       [&](const Keypoint& k) { return (k.point - witness).norm() <= 0.03; });
        }
      }
      EXPECT_GE(found * 100, count * 95) << found << " of " << count << ", " << sequence << ", " << detector;
    }
  }
}

}  // namespace
}  // namespace beaconless
