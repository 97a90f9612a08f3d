// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/protection_level.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "beaconless/match/icp.hpp"
#include "beaconless/match/wall_pairs.hpp"
#include "beaconless/match/wall_rest.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/faulty_scans.hpp"
#include "tests/support/wall_room.hpp"

namespace beaconless {
namespace {

constexpr Pose2 kThere{2.1, 1.6, 0.3};

std::vector<WallPiece> summed(const WallBeams& beams, const Pose2& step, VectorLoop loop) {
  WallMarks marks;
  std::vector<WallPiece> pieces;
  divide(beams, loop, marks, pieces);
  sum_walls(beams, step, 6.0, loop, &marks);
  add_up(marks, pieces);
  return pieces;
}

/// The pieces of a scan of the room with a niche, at the fit of all its beams.
struct Pieces {
  Pieces() : room(test::niche_room()) {
    const RawScan raw = room.see(kThere);
    points = test::points_of(Scan::make(raw).value());
    const MatchResult fit = match_walls(points, room.index, kThere, 0.02, room.config, room.scratch);
    pair_with_walls(points, room.index, fit.map_from_laser, 0.1, room.config, beams, VectorLoop::portable);
    pieces = summed(beams, {}, VectorLoop::portable);
    for (const WallPiece& piece : pieces) all += piece.sums;
  }

  test::WallRoom room;
  std::vector<Eigen::Vector2d> points;
  WallBeams beams;
  std::vector<WallPiece> pieces;
  PartialSums all;
};

TEST(WallPieces, AddUpToTheSumsOfAllBeams) {
  const Pieces of;
  for (const VectorLoop loop : {VectorLoop::portable, fastest_vector_loop()}) {
    const Pose2 step{0.003, -0.002, 0.001};
    PartialSums all;
    for (const WallPiece& piece : summed(of.beams, step, loop)) all += piece.sums;
    const WallSums told = sum_walls(of.beams, step, 6.0, loop);
    const double most = told.hessian.cwiseAbs().maxCoeff();
    EXPECT_NEAR(all.hessian[0], told.hessian(0, 0), 1e-9 * most);
    EXPECT_NEAR(all.hessian[1], told.hessian(0, 1), 1e-9 * most);
    EXPECT_NEAR(all.hessian[4], told.hessian(1, 2), 1e-9 * most);
    EXPECT_NEAR(all.hessian[5], told.hessian(2, 2), 1e-9 * most);
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_NEAR(all.gradient[static_cast<std::size_t>(i)], told.gradient[i], 1e-9 * most);
  }
}

TEST(WallPieces, AreOfTheBeamsOfOneWallAlone) {
  // Beams so few that most lanes are of two walls.
  test::WallRoom room(test::niche_room());
  const auto all = test::points_of(Scan::make(room.see(kThere)).value());
  std::vector<Eigen::Vector2d> some;
  for (std::size_t i = 0; i < all.size(); i += 37) some.push_back(all[i]);
  for (const VectorLoop loop : {VectorLoop::portable, fastest_vector_loop()}) {
    WallBeams beams;
    pair_with_walls(some, room.index, kThere, 0.1, room.config, beams, loop);
    const std::vector<WallPiece> pieces = summed(beams, {}, loop);
    ASSERT_GT(pieces.size(), 5U);
    std::size_t first = 0;
    for (const WallPiece& piece : pieces) {
      // The same beams by themselves.
      WallBeams own;
      own.reserve(piece.end - first);
      for (; first < piece.end; ++first) {
        EXPECT_EQ(beams.nx[first], piece.nx);
        EXPECT_EQ(beams.offset_m[first], piece.offset_m);
        own.add({beams.x_m[first], beams.y_m[first]}, {beams.ux[first], beams.uy[first]},
                {piece.nx, piece.ny}, piece.offset_m, beams.information[first]);
      }
      own.fill_up();
      const WallSums told = sum_walls(own, {}, 6.0, loop);
      const double most = told.hessian.cwiseAbs().maxCoeff();
      EXPECT_NEAR(piece.sums.hessian[0], told.hessian(0, 0), 1e-9 * most);
      EXPECT_NEAR(piece.sums.hessian[4], told.hessian(1, 2), 1e-9 * most);
      EXPECT_NEAR(piece.sums.gradient[2], told.gradient[2], 1e-9 * most);
    }
    EXPECT_EQ(first, beams.count);
  }
}

TEST(WallRest, IsWhereAFitWithoutThosePiecesGoes) {
  const Pieces of;
  const SeparatedFit fit;
  for (int octant = 0; octant < 8; ++octant) {
    // 1. To first order.
    PartialSums left_out;
    for (const WallPiece& piece : of.pieces)
      if (piece.octant == octant) left_out += piece.sums;
    if (left_out.across() == 0.0) continue;
    const WallRest rest = rest_without(of.all, left_out, {}, fit);
    ASSERT_TRUE(rest.is_determined);
    // 2. Slowly: beam by beam, step by step.
    Pose2 slow;
    for (int step = 0; step < 20; ++step) {
      Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (const WallPiece& piece : summed(of.beams, slow, VectorLoop::portable)) {
        if (piece.octant == octant) continue;
        const auto& [xx, xy, yy, xt, yt, tt] = piece.sums.hessian;
        Eigen::Matrix3d of_piece;
        of_piece << xx, xy, xt, xy, yy, yt, xt, yt, tt;
        hessian += of_piece;
        gradient += Eigen::Vector3d(piece.sums.gradient[0], piece.sums.gradient[1], piece.sums.gradient[2]);
      }
      slow = stepped(slow, -hessian.ldlt().solve(gradient));
    }
    const double way_m = slow.translation().norm();
    EXPECT_NEAR(rest.dx_m, slow.x_m, 0.25 * way_m + 2e-5) << octant;
    EXPECT_NEAR(rest.dy_m, slow.y_m, 0.25 * way_m + 2e-5) << octant;
    EXPECT_NEAR(rest.dtheta_rad, slow.theta_rad, 0.25 * std::abs(slow.theta_rad) + 2e-5) << octant;
  }
}

TEST(ProtectionLevel, IsSmallInARoomThatIsAsDrawn) {
  test::WallRoom room(test::niche_room());
  const MatchResult fit = room.match(room.see(kThere), kThere, 0.02);
  EXPECT_LT(distance_m(fit.map_from_laser, kThere), fit.protection.position_m);
  EXPECT_LT(fit.protection.position_m, 0.06);
  EXPECT_LT(fit.protection.heading_rad, radians(1.5));
}

TEST(ProtectionLevel, GrowsWithWhatStandsBeforeAWall) {
  test::WallRoom room(test::niche_room());
  const RawScan clean = room.see(kThere, 0.0);
  double before_m = room.match(clean, kThere, 0.02).protection.position_m;
  for (const float off_m : {0.01F, 0.02F, 0.03F}) {
    RawScan raw = clean;
    for (std::size_t i = 300; i < 560; ++i) raw.ranges_m[i] -= off_m;
    const MatchResult fit = room.match(raw, kThere, 0.02);
    EXPECT_GT(fit.protection.position_m, before_m) << off_m;
    EXPECT_GT(fit.protection.position_m, distance_m(fit.map_from_laser, kThere)) << off_m;
    before_m = fit.protection.position_m;
  }
}

TEST(ProtectionLevel, IsUnboundedWhereOneWallHoldsADirection) {
  // Two long walls, and one end in sight.
  test::WallRoom corridor(FloorPlan{{{{0, 0}, {100, 0}}, {{0, 2.2}, {100, 2.2}}, {{0, 0}, {0, 2.2}}}});
  const Pose2 there{5.0, 1.0, kPi};
  const MatchResult fit = corridor.match(corridor.see(there), there, 0.02);
  ASSERT_EQ(fit.rank, 3);
  EXPECT_FALSE(fit.protection.is_bounded());
  EXPECT_EQ(fit.protection, ProtectionLevel{});
}

TEST(ProtectionLevel, IsUnboundedWhereADirectionIsOpen) {
  test::WallRoom corridor(FloorPlan{{{{-200, 0}, {200, 0}}, {{-200, 2.2}, {200, 2.2}}}});
  const MatchResult fit = corridor.match(corridor.see({0, 1, 0.1}), {0, 1, 0.1}, 0.02);
  ASSERT_LT(fit.rank, 3);
  EXPECT_EQ(fit.protection, ProtectionLevel{});
}

TEST(ProtectionLevel, GrowsAsTheRiskFalls) {
  test::WallRoom room(test::niche_room());
  const RawScan raw = room.see(kThere);
  double before_m = 0.0;
  for (const double risk : {1e-2, 1e-4, 1e-7}) {
    room.config.protection.risk = risk;
    const double level_m = room.match(raw, kThere, 0.02).protection.position_m;
    EXPECT_GT(level_m, before_m);
    before_m = level_m;
  }
  EXPECT_NEAR(protection_sigmas(1e-4), 4.29, 0.005);  // exp(-4.29²/2) = 1e-4
}

TEST(ProtectionLevel, IsTheSameTwiceAndAsksForNoMemory) {
  test::WallRoom room(test::niche_room());
  RawScan raw = room.see(kThere);
  for (std::size_t i = 200; i < 400; ++i) raw.ranges_m[i] -= 0.12F;
  const auto points = test::points_of(Scan::make(raw).value());
  const MatchResult first = match_walls(points, room.index, kThere, 0.02, room.config, room.scratch);
  const std::size_t before = test::allocations();
  const MatchResult second = match_walls(points, room.index, kThere, 0.02, room.config, room.scratch);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_EQ(first.protection, second.protection);
}

/// Faults of which there is one at a time; bench/protection_bench counts all of them in many more scans.
TEST(ProtectionLevel, HoldsInPlacesThatAreNotAsDrawn) {
  Rng rng(77);
  IcpScratch icp;
  WallsScratch scratch;
  int beyond = 0;
  int scans = 0;
  for (int of = 0; of < 60; ++of) {
    const test::FaultyWorld world(test::kPlaces[static_cast<std::size_t>(of) % test::kPlaces.size()], rng);
    const SurfaceMap map(std::in_place_type<WallIndex>, world.plan());
    for (const auto fault :
         {test::Fault::none, test::Fault::people, test::Fault::row, test::Fault::moved, test::Fault::wall,
          test::Fault::unmapped, test::Fault::glass, test::Fault::noise}) {
      const test::FaultyScan scan = test::see_faulty(world, fault, rng);
      const MatchResult near = match_icp(scan.points, map, scan.truth, {}, icp);
      const MatchResult fit =
          match_walls(scan.points, std::get<WallIndex>(map), near.map_from_laser, 0.1, {}, scratch);
      EXPECT_TRUE(std::isfinite(fit.protection.position_m) && fit.protection.position_m > 0.0);
      EXPECT_LE(fit.protection.position_m, ProtectionLevel::kUnbounded_m);
      EXPECT_LE(fit.protection.heading_rad, kPi);
      if (!fit.usable() || fit.rank < 3 || fit.on_map_ratio < 0.5) continue;
      ++scans;
      beyond += distance_m(fit.map_from_laser, scan.truth) > fit.protection.position_m ? 1 : 0;
    }
  }
  EXPECT_GT(scans, 450);
  EXPECT_LE(beyond, 1);  // one in ten thousand are 0.05 of them; with nothing left out there are five
}

}  // namespace
}  // namespace beaconless
