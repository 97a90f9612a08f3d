// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/split.hpp"

#include <gmock/gmock.h>

#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/geometry/line2.hpp"

#include "tests/features/made_scans.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Vertices = std::vector<std::size_t>;

/// As the textbook has it: recursion, and the formula with a square root.
void slow_twin(const Points& points, std::size_t first, std::size_t last, double epsilon_m,
               Vertices& vertices) {
  double most = 0.0;
  std::size_t index = first;
  const auto chord = Line2::through(points[first], points[last]);
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance =
        chord ? std::abs(chord->signed_distance_m(points[i])) : (points[i] - points[first]).norm();
    if (distance > most) {
      most = distance;
      index = i;
    }
  }
  if (most > epsilon_m) {
    slow_twin(points, first, index, epsilon_m, vertices);
    slow_twin(points, index, last, epsilon_m, vertices);
  } else {
    vertices.push_back(last);
  }
}

Vertices slow_split(const Points& points, double epsilon_m) {
  Vertices vertices{0};
  slow_twin(points, 0, points.size() - 1, epsilon_m, vertices);
  return vertices;
}

Points random_walk(int count, Rng& rng) {
  Points points{{0, 0}};
  double heading = 0.0;
  for (int i = 1; i < count; ++i) {
    if (rng.uniform() < 0.1) heading += rng.uniform(-2, 2);
    points.emplace_back(points.back() + Eigen::Vector2d(0.05 * std::cos(heading), 0.05 * std::sin(heading)) +
                        Eigen::Vector2d(rng.normal(0.01), rng.normal(0.01)));
  }
  return points;
}

TEST(Split, AgreesWithItsSlowTwin) {
  Rng rng(1);
  for (int run = 0; run < 200; ++run) {
    const Points points = random_walk(2 + static_cast<int>(rng.uniform(0, 300)), rng);
    const double epsilon = rng.uniform(0.01, 0.3);
    EXPECT_EQ(split(points, {.epsilon_m = epsilon}), slow_split(points, epsilon));
  }
}

TEST(Split, OfAScanAgreesWithTheSlowTwinOnItsSegments) {
  Rng rng(2);
  const RayCaster walls(test::niche_room().segments());
  int vertices_seen = 0;
  for (int run = 0; run < 50; ++run) {
    const Scan scan =
        test::seen(walls, {rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-3, 3)}, 0.01, rng);
    const auto segments = segment_by_distance(scan);
    std::vector<ScanSegment> expected;
    for (const ScanSegment& segment : segments) {
      Points points;
      for (std::size_t k = 0; k < segment.count; ++k) points.push_back(scan.point(segment.first + k));
      if (points.size() == 1) {
        expected.push_back(segment);
        continue;
      }
      const Vertices vertices = slow_split(points, 0.05);
      for (std::size_t v = 0; v + 1 < vertices.size(); ++v)
        expected.push_back({segment.first + vertices[v], vertices[v + 1] - vertices[v] + 1});
      vertices_seen += static_cast<int>(vertices.size());
    }
    EXPECT_EQ(split(scan, segments), expected);
  }
  EXPECT_GT(vertices_seen, 400);
}

TEST(Split, PointsOnALineKeepTheirEndsOnly) {
  Points points;
  for (int i = 0; i < 100; ++i) points.emplace_back(0.25 * i, 0.5 * i);
  EXPECT_EQ(split(points, {.epsilon_m = 1e-9}), (Vertices{0, 99}));
}

TEST(Split, APolygonKeepsItsVertices) {
  for (const int sides : {3, 4, 5, 6, 8, 12}) {
    Points points;
    Vertices vertices;
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * kPi * k / sides;
      const double b = 2 * kPi * (k + 1) / sides;
      const Eigen::Vector2d from(std::cos(a), std::sin(a));
      const Eigen::Vector2d to(std::cos(b), std::sin(b));
      vertices.push_back(points.size());
      for (int i = 0; i < 20; ++i) points.emplace_back(from + (to - from) * i / 20.0);
    }
    vertices.push_back(points.size());
    points.push_back(points.front());  // closed: the ends coincide
    EXPECT_EQ(split(points, {.epsilon_m = 0.01}), vertices) << sides;
  }
}

TEST(Split, IsASubsetWithBothEndsAndWithinEpsilon) {
  Rng rng(3);
  for (int run = 0; run < 100; ++run) {
    const Points points = random_walk(200, rng);
    const double epsilon = rng.uniform(0.02, 0.2);
    const Vertices vertices = split(points, {.epsilon_m = epsilon});
    EXPECT_EQ(vertices.front(), 0U);
    EXPECT_EQ(vertices.back(), points.size() - 1);
    EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end()));
    for (std::size_t v = 0; v + 1 < vertices.size(); ++v) {
      const auto chord = Line2::through(points[vertices[v]], points[vertices[v + 1]]);
      for (std::size_t i = vertices[v]; i <= vertices[v + 1] && chord; ++i)
        EXPECT_LE(std::abs(chord->signed_distance_m(points[i])), epsilon + 1e-12);
    }
  }
}

TEST(Split, TwiceIsOnce) {
  Rng rng(4);
  for (int run = 0; run < 100; ++run) {
    const Points points = random_walk(200, rng);
    Points kept;
    for (const std::size_t v : split(points)) kept.push_back(points[v]);
    EXPECT_EQ(split(kept).size(), kept.size());
  }
}

TEST(Split, FewerVerticesWithALargerEpsilonOnAConvexArc) {
  Points arc;
  for (int i = 0; i <= 200; ++i) arc.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i));
  std::size_t before = arc.size() + 1;
  for (double epsilon = 1e-5; epsilon < 1.0; epsilon *= 2.0) {
    const std::size_t now = split(arc, {.epsilon_m = epsilon}).size();
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_EQ(before, 2U);
}

TEST(Split, NoPointsOnePointAndEqualPoints) {
  EXPECT_TRUE(split(Points{}).empty());
  EXPECT_EQ(split(Points{{1, 2}}), Vertices{0});
  EXPECT_EQ(split(Points(5, Eigen::Vector2d(1, 2))), (Vertices{0, 4}));
  for (const int beams : {1, 2}) {
    const Scan scan = test::scan_of({.beams = beams}, [](int, double) { return 1.0; });
    EXPECT_EQ(split(scan), (std::vector<ScanSegment>{{0, static_cast<std::size_t>(beams)}}));
  }
}

TEST(Split, WithoutSegmentationOnlyMissesCut) {
  const Scan scan = test::scan_of({}, [](int i, double) { return i == 300 ? 0.0 : i < 600 ? 2.0 : 4.0; });
  const auto pieces = split(scan, {.epsilon_m = 100.0});
  EXPECT_EQ(pieces, (std::vector<ScanSegment>{{0, 300}, {301, 780}}));
}

TEST(Split, AClosedRoomIsCutAtItsCorners) {
  Rng rng(5);
  const RayCaster walls(test::rectangle(4, 3).segments());
  const Scan scan = test::seen(walls, {1.7, 1.2, 0.0}, 0.0, rng, test::kFullCircle);
  for (const std::size_t by : {0U, 1U, 500U, 1439U}) {
    const Scan room = test::turned(scan, by);
    const auto pieces = split(room, segment_by_distance(room));
    EXPECT_EQ(pieces.size(), 4U) << by;
    std::size_t beams = 0;
    for (const ScanSegment& piece : pieces) beams += piece.count - 1;
    EXPECT_EQ(beams, room.size() - 1);
  }
}

TEST(Split, AllocatesNothingPerScan) {
  Rng rng(6);
  const RayCaster walls(test::niche_room().segments());
  const Scan scan = test::seen(walls, {3, 2, 0.3}, 0.01, rng, test::kFullCircle);
  const auto segments = segment_by_distance(scan);
  SplitScratch scratch;
  std::vector<ScanSegment> pieces;
  split(scan, segments, {}, scratch, pieces);
  const std::size_t before = test::allocations();
  split(scan, segments, {}, scratch, pieces);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
