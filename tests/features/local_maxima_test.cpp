// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/local_maxima.hpp"

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// A round wall of 720 beams, 5 m away.
Scan round_room() {
  RawScan raw{.angle_increment_rad = static_cast<float>(2.0 * kPi / 720.0),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  raw.ranges_m.assign(720, 5.0F);
  return Scan::make(raw).value();
}

std::vector<Keypoint> at_beams(const Scan& scan, const std::vector<std::pair<std::size_t, double>>& scores) {
  std::vector<Keypoint> keypoints;
  for (const auto& [beam, score] : scores)
    keypoints.push_back({.beam = beam, .point = scan.point(beam), .score = score});
  return keypoints;
}

std::vector<std::size_t> kept(const Scan& scan, std::vector<Keypoint> keypoints, double radius_m) {
  std::vector<Keypoint> buffer;
  keep_local_maxima(scan, radius_m, keypoints, buffer);
  std::vector<std::size_t> beams;
  for (const Keypoint& keypoint : keypoints) beams.push_back(keypoint.beam);
  return beams;
}

TEST(LocalMaxima, KeepsEqualOnesThatAreFarApart) {
  const Scan scan = round_room();
  const auto four = at_beams(scan, {{100, 1.0}, {300, 1.0}, {500, 1.0}, {700, 1.0}});
  EXPECT_EQ(kept(scan, four, 0.1), (std::vector<std::size_t>{100, 300, 500, 700}));
}

TEST(LocalMaxima, KeepsTheFirstOfAPlateauAndTheBestOfAHill) {
  const Scan scan = round_room();  // 4.4 cm between beams
  EXPECT_EQ(kept(scan, at_beams(scan, {{10, 1.0}, {11, 1.0}, {12, 1.0}}), 0.1),
            (std::vector<std::size_t>{10}));
  EXPECT_EQ(kept(scan, at_beams(scan, {{10, 0.5}, {11, 0.9}, {12, 0.7}}), 0.1),
            (std::vector<std::size_t>{11}));
}

TEST(LocalMaxima, GoesRoundAFullCircle) {
  const Scan scan = round_room();
  EXPECT_EQ(kept(scan, at_beams(scan, {{0, 0.5}, {300, 0.1}, {719, 0.9}}), 0.1),
            (std::vector<std::size_t>{300, 719}));
}

TEST(LocalMaxima, AreThoseOfTheDefinition) {
  const Scan scan = round_room();
  Rng rng(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::pair<std::size_t, double>> scores;
    for (std::size_t beam = 0; beam < 720; ++beam)
      if (rng.uniform() < 0.3) scores.emplace_back(beam, std::floor(rng.uniform(0.0, 5.0)));
    const auto keypoints = at_beams(scan, scores);
    std::vector<std::size_t> twin;
    for (const Keypoint& self : keypoints) {
      bool best = true;
      for (const Keypoint& other : keypoints) {
        if ((other.point - self.point).norm() > 0.2) continue;
        best = best && !(other.score > self.score || (other.score == self.score && other.beam < self.beam));
      }
      if (best) twin.push_back(self.beam);
    }
    EXPECT_EQ(kept(scan, keypoints, 0.2), twin);
  }
}

}  // namespace
}  // namespace beaconless
