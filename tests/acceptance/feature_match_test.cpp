// SPDX-License-Identifier: Apache-2.0
// What features are worth: the pose of a scan in the frame of another one taken half a second earlier, found
// without a guess. Skipped where the recordings are not.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "beaconless/features/beta_grid.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/features/falko.hpp"
#include "beaconless/features/flirt.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/match/match_features.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless {
namespace {

/// The features of one scan.
struct Seen {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> orientations_rad;
  std::vector<int> kinds;
  std::vector<BetaGrid> descriptors;

  FeatureSet set() const { return {points, orientations_rad, kinds}; }
};

Seen seen(const Scan& scan, const std::vector<Keypoint>& keypoints, bool describe) {
  Seen seen;
  for (const Keypoint& keypoint : keypoints) {
    seen.points.push_back(keypoint.point);
    seen.orientations_rad.push_back(keypoint.orientation_rad);
  }
  if (describe) seen.descriptors = describe_beta_grid(scan, keypoints);
  return seen;
}

Seen by_falko(const Scan& scan) { return seen(scan, detect_falko(scan), false); }

Seen by_flirt_range(const Scan& scan) {
  return seen(scan, detect_flirt(scan, flirt_defaults(FlirtKind::range)), true);
}

Seen by_corners(const Scan& scan) {
  std::vector<Keypoint> keypoints;
  std::vector<int> kinds;
  for (const Corner& corner : find_corners(scan)) {
    keypoints.push_back(keypoint_of(corner));
    kinds.push_back(corner.is_convex ? 1 : 0);
  }
  Seen corners = seen(scan, keypoints, false);
  corners.kinds = kinds;
  return corners;
}

struct Way {
  const char* name;
  const char* drive;
  Seen (*features)(const Scan&);
  FeatureMatchMethod method;
  double median_m;     ///< allowed
  double found_ratio;  ///< asked: within 0.1 m and 2°
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

std::string name_of(const testing::TestParamInfo<Way>& way) { return way.param.name; }

class FeatureMatching : public testing::TestWithParam<Way> {};

TEST_P(FeatureMatching, FindsThePoseOfAScanInAnEarlierOne) {
  constexpr std::size_t kApart = 20;
  constexpr std::size_t kStep = 4;
  const Way& way = GetParam();
  const std::string drive = std::string("sim_rooms/") + way.drive;
  if (recorded(drive + ".carmen.log.gz").empty())
    GTEST_SKIP() << drive << " is not here; BEACONLESS_DATA names its folder";
  const auto truth = io::read_tum(recorded(drive + ".truth.tum")).value();
  std::vector<Seen> views;
  for (const Event& event : io::open_recording(recorded(drive + ".carmen.log.gz")).value())
    if (std::holds_alternative<Scan>(event)) views.push_back(way.features(std::get<Scan>(event)));
  ASSERT_EQ(views.size(), truth.size());

  FeatureMatchConfig config;
  config.method = way.method;
  FeatureMatchScratch scratch;
  FeatureMatch match;
  std::vector<float> distances;
  std::vector<double> errors_m;
  std::size_t found = 0;
  std::size_t wrong = 0;
  double nees = 0.0;
  for (std::size_t i = 0; i + kApart < views.size(); i += kStep) {
    const Seen& earlier = views[i];
    const Seen& later = views[i + kApart];
    descriptor_distances<BetaGrid>(later.descriptors, earlier.descriptors, distances);
    match_features(later.set(), earlier.set(), config, distances, {}, scratch, match);
    errors_m.push_back(std::numeric_limits<double>::infinity());
    if (!match.result.usable()) continue;
    const Pose2 expected = truth[i].pose.inverse() * truth[i + kApart].pose;
    const Pose2& pose = match.result.map_from_laser;
    errors_m.back() = distance_m(pose, expected);
    const bool right = errors_m.back() < 0.1 && heading_difference_rad(pose, expected) < radians(2.0);
    (right ? found : wrong) += 1;
    const Eigen::Vector3d error(pose.x_m - expected.x_m, pose.y_m - expected.y_m,
                                wrap_angle(pose.theta_rad - expected.theta_rad));
    nees += error.dot(match.result.covariance.ldlt().solve(error));
  }
  std::sort(errors_m.begin(), errors_m.end());
  const auto all = static_cast<double>(errors_m.size());
  EXPECT_LE(errors_m[errors_m.size() / 2], way.median_m);
  EXPECT_GE(static_cast<double>(found) / all, way.found_ratio);
  EXPECT_EQ(wrong, 0U);  // too few pairs is an answer, another place is not
  // Features of two scans of one detector share some of their error, so the covariance may say too much.
  EXPECT_LT(nees / static_cast<double>(found), 3.5);
}

// Allowed is half of what existing programs reach (FALKO and clique 8 mm, FLIRT range and RANSAC 31 mm), and
// for corners, which nobody measured, the figure the issue asks of them: 5 mm.
INSTANTIATE_TEST_SUITE_P(
    Ways, FeatureMatching,
    testing::Values(Way{"falko_clique", "b1_ellipse", by_falko, FeatureMatchMethod::clique, 0.004, 0.97},
                    Way{"falko_ransac", "b1_ellipse", by_falko, FeatureMatchMethod::ransac, 0.004, 0.97},
                    Way{"falko_hough", "b1_ellipse", by_falko, FeatureMatchMethod::hough, 0.004, 0.97},
                    Way{"flirt_ransac", "b1_ellipse", by_flirt_range, FeatureMatchMethod::ransac, 0.015,
                        0.97},
                    Way{"corners_clique", "b1_ellipse", by_corners, FeatureMatchMethod::clique, 0.005, 0.97},
                    Way{"falko_static", "a1_static", by_falko, FeatureMatchMethod::clique, 0.004, 0.97}),
    name_of);

}  // namespace
}  // namespace beaconless
