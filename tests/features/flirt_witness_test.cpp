// SPDX-License-Identifier: Apache-2.0
// What flirtlib found on the same scans with the same parameters, and how well keypoints are found again.
// Skipped where the recordings are not. docs/concepts/flirt-agreement.md explains the figures.
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "beaconless/eval/repeatability.hpp"
#include "beaconless/features/flirt.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless {
namespace {

struct Drive {
  std::vector<Scan> scans;
  std::vector<Pose2> map_from_laser;
};

/// Empty where the recording is not.
const Drive& drive(const std::string& name) {
  static std::map<std::string, Drive> drives;
  const auto known = drives.find(name);
  if (known != drives.end()) return known->second;
  Drive& drive = drives[name];
  const std::string log = recorded("sim_rooms/" + name + ".carmen.log.gz");
  if (log.empty()) return drive;
  for (const Event& event : io::open_recording(log).value())
    if (const auto* scan = std::get_if<Scan>(&event)) drive.scans.push_back(*scan);
  const Trajectory truth = io::read_tum(recorded("sim_rooms/" + name + ".truth.tum")).value();
  for (std::size_t i = 0; i < truth.size(); ++i) drive.map_from_laser.push_back(truth[i].pose);
  return drive;
}

/// The points that one detector of the reference programs found, by scan.
std::map<std::size_t, std::vector<Eigen::Vector2d>> witness(const std::string& sequence,
                                                            const std::string& detector) {
  std::map<std::size_t, std::vector<Eigen::Vector2d>> points;
  std::ifstream in(recorded("oracles/keypoints.csv"));
  std::string line;
  while (std::getline(in, line)) {
    std::stringstream row(line);
    std::string words[6];
    for (std::string& word : words) std::getline(row, word, ',');
    if (words[0] == sequence && words[1] == detector)
      points[std::stoul(words[2])].emplace_back(std::stod(words[4]), std::stod(words[5]));
  }
  return points;
}

std::vector<Eigen::Vector2d> places(const std::vector<Keypoint>& keypoints) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) points.push_back(keypoint.point);
  return points;
}

double share_near(const std::vector<Eigen::Vector2d>& points, const std::vector<Eigen::Vector2d>& others) {
  const auto count = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector2d& point) {
    return std::any_of(others.begin(), others.end(),
                       [&](const Eigen::Vector2d& other) { return (other - point).norm() <= 0.05; });
  });
  return static_cast<double>(count);
}

struct Agreement {
  const char* sequence;
  const char* detector;
  FlirtKind kind;
  double found;       ///< share of flirtlib's keypoints that are within 5 cm of one of ours
  double found_back;  ///< share of ours that are within 5 cm of one of flirtlib's
};

void PrintTo(const Agreement& agreement, std::ostream* out) {
  *out << agreement.sequence << " " << agreement.detector;
}

class FlirtWitness : public testing::TestWithParam<Agreement> {};

TEST_P(FlirtWitness, AgreesWithTheToolsParameters) {
  const auto& [sequence, detector, kind, found, found_back] = GetParam();
  const auto points = witness(sequence, detector);
  if (points.empty() || drive(sequence).scans.empty())
    GTEST_SKIP() << sequence << " is not here; BEACONLESS_DATA names its folder";
  double near = 0.0;
  double near_back = 0.0;
  double theirs = 0.0;
  double ours = 0.0;
  for (const auto& [scan, there] : points) {
    const auto here = places(detect_flirt(drive(sequence).scans[scan], flirtlib_tools(kind)));
    near += share_near(there, here);
    near_back += share_near(here, there);
    theirs += static_cast<double>(there.size());
    ours += static_cast<double>(here.size());
  }
  EXPECT_GE(near / theirs, found) << near << " of " << theirs;
  EXPECT_GE(near_back / ours, found_back) << near_back << " of " << ours;
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, FlirtWitness,
    testing::Values(Agreement{"b1_ellipse", "flirt_range", FlirtKind::range, 1.0, 1.0},
                    Agreement{"a1_static", "flirt_normal_blob", FlirtKind::normal_blob, 1.0, 1.0},
                    Agreement{"b1_ellipse", "flirt_normal_blob", FlirtKind::normal_blob, 1.0, 1.0},
                    Agreement{"a1_static", "flirt_normal_edge", FlirtKind::normal_edge, 0.98, 0.98},
                    Agreement{"b1_ellipse", "flirt_normal_edge", FlirtKind::normal_edge, 1.0, 1.0},
                    Agreement{"b1_ellipse", "flirt_curvature", FlirtKind::curvature, 0.66, 0.65}));

struct Again {
  const char* sequence;
  FlirtKind kind;
  double found_ratio;
  double points_per_scan;
};

void PrintTo(const Again& again, std::ostream* out) {
  *out << again.sequence << " " << static_cast<int>(again.kind);
}

class FlirtRepeatability : public testing::TestWithParam<Again> {};

eval::Repeatability repeatability(const Drive& drive, const FlirtConfig& config) {
  FlirtScratch scratch;
  std::vector<Keypoint> keypoints;
  std::vector<std::vector<Eigen::Vector2d>> points;
  std::vector<eval::View> views;
  points.reserve(drive.scans.size());
  views.reserve(drive.scans.size());
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    detect_flirt(drive.scans[i], config, scratch, keypoints);
    points.push_back(places(keypoints));
    views.push_back({&drive.scans[i], drive.map_from_laser[i], points.back()});
  }
  return eval::repeatability(views, 10);
}

TEST_P(FlirtRepeatability, FindsItsKeypointsAgainTenScansLater) {
  const Again& again = GetParam();
  if (drive(again.sequence).scans.empty())
    GTEST_SKIP() << again.sequence << " is not here; BEACONLESS_DATA names its folder";
  const auto ours = repeatability(drive(again.sequence), flirt_defaults(again.kind));
  EXPECT_GE(ours.found_ratio(), again.found_ratio);
  EXPECT_GE(ours.points_per_scan(), again.points_per_scan);
}

// Two hundredths below what was measured; the points are at least as many as flirtlib's on b1.
INSTANTIATE_TEST_SUITE_P(Rooms, FlirtRepeatability,
                         testing::Values(Again{"b1_ellipse", FlirtKind::range, 0.84, 23.0},
                                         Again{"b1_ellipse", FlirtKind::normal_blob, 0.77, 45.0},
                                         Again{"b1_ellipse", FlirtKind::normal_edge, 0.86, 23.9},
                                         Again{"b1_ellipse", FlirtKind::curvature, 0.83, 38.0},
                                         Again{"a1_static", FlirtKind::normal_edge, 0.85, 3.0},
                                         Again{"a1_static", FlirtKind::curvature, 0.83, 6.0}));

}  // namespace
}  // namespace beaconless
