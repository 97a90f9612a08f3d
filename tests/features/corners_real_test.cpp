// SPDX-License-Identifier: Apache-2.0
// Corners of recordings that are kept outside the project. Skipped where they are not.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "beaconless/eval/repeatability.hpp"
#include "beaconless/features/circles.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"

namespace beaconless {
namespace {

std::string recorded(const std::string& name) {
  const char* named = std::getenv("BEACONLESS_DATA");
  const std::filesystem::path folder = named != nullptr
                                           ? std::filesystem::path(named)
                                           : std::filesystem::path(BEACONLESS_SOURCE_DIR) / "../shared/data";
  return std::filesystem::exists(folder / name) ? (folder / name).string() : "";
}

#define SKIP_WITHOUT(name) \
  if (recorded(name).empty()) GTEST_SKIP() << (name) << " is not here; BEACONLESS_DATA names its folder"

/// Scans of a room simulated by an independent program, and where they were truly taken.
struct Room {
  std::vector<Scan> scans;
  Trajectory truth;

  explicit Room(const std::string& name)
      : truth(io::read_tum(recorded("sim_rooms/" + name + ".truth.tum")).value()) {
    for (const Event& event : io::open_recording(recorded("sim_rooms/" + name + ".carmen.log.gz")).value())
      if (const auto* scan = std::get_if<Scan>(&event)) scans.push_back(*scan);
  }

  eval::Repeatability again(const CornersConfig& config) const {
    std::vector<std::vector<Eigen::Vector2d>> points(scans.size());
    std::vector<eval::View> views;
    CornersScratch scratch;
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      find_corners(scans[i], config, scratch, corners);
      for (const Corner& corner : corners) points[i].push_back(corner.point);
      views.push_back({&scans[i], truth[i].pose, points[i]});
    }
    return eval::repeatability(views, 10);
  }
};

TEST(CornersOfRecordings, AreFoundAgainTenScansLater) {
  SKIP_WITHOUT("sim_rooms/b1_ellipse.carmen.log.gz");
  const eval::Repeatability again = Room("b1_ellipse").again({});
  EXPECT_GE(again.found_ratio(), 0.92);
  EXPECT_LE(again.mean_distance_m(), 0.006);
  EXPECT_GE(again.points_per_scan(), 7.5);
  // The cost of being sure that nothing hides behind an edge.
  CornersConfig sure;
  sure.reach_beams = 1.0;
  EXPECT_GE(Room("b1_ellipse").again(sure).found_ratio(), 0.88);
}

TEST(CornersOfRecordings, AllThreeOfAnEmptyRoomNearlyAlways) {
  SKIP_WITHOUT("sim_rooms/a1_static.carmen.log.gz");
  const eval::Repeatability again = Room("a1_static").again({});
  EXPECT_GE(again.found_ratio(), 0.99);
  EXPECT_GE(again.points_per_scan(), 2.98);
  EXPECT_LE(again.mean_distance_m(), 0.0025);
}

TEST(CornersOfRecordings, TheOneColumnIsFoundAndNoOther) {
  SKIP_WITHOUT("sim_rooms/b1_ellipse.carmen.log.gz");
  const Room room("b1_ellipse");
  const Eigen::Vector2d column(6.877, 6.105);  // a polygon of 16 sides, 0.22 m
  int found = 0;
  for (std::size_t i = 0; i < room.scans.size(); ++i)
    for (const ScanCircle& circle : find_circles(room.scans[i])) {
      EXPECT_LT((room.truth[i].pose * circle.fit.circle.centre - column).norm(), 0.1) << i;
      ++found;
    }
  EXPECT_GT(found, 1000);
}

/// Real scanners, each of another kind.
class CornersOf : public testing::TestWithParam<const char*> {};

TEST_P(CornersOf, LieWhereTheScanHasBeams) {
  SKIP_WITHOUT(GetParam());
  CornersScratch scratch;
  std::vector<Corner> corners;
  int all = 0;
  int scans = 0;
  for (const Event& event : io::open_recording(recorded(GetParam())).value()) {
    const auto* scan = std::get_if<Scan>(&event);
    if (scan == nullptr) continue;
    if (++scans > 200) break;
    find_corners(*scan, {}, scratch, corners);
    for (const Corner& corner : corners) {
      ++all;
      ASSERT_TRUE(corner.covariance.allFinite());
      EXPECT_LT((scan->point(corner.beam) - corner.point).norm(), 0.4);
      EXPECT_GT(corner.angle_rad, radians(25));
      for (const std::size_t line : {corner.first_line, corner.second_line})
        EXPECT_LT(scratch.lines.at(line).fit.rms_m, 0.06);
    }
  }
  EXPECT_GT(all, scans / 2);
}

INSTANTIATE_TEST_SUITE_P(Recordings, CornersOf,
                         testing::Values("fr079/freiburg-079-corrected.log.gz",
                                         "jarvis/jarvis_circular_nav350_utm30lx_crop.carmen.log.gz",
                                         "mit_csail/csail-corrected.log.gz",
                                         "radish/seattle-corrected.log.gz"));

}  // namespace
}  // namespace beaconless
