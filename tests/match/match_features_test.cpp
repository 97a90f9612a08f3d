// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/match_features.hpp"

#include <limits>
#include <numeric>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/rigid_fit.hpp"
#include "beaconless/match/pairs_by_chance.hpp"

namespace beaconless {
namespace {

/// Two views of the same features: some seen in both, in another order, and some in one only.
struct Views {
  std::vector<Eigen::Vector2d> first, second;
  std::vector<double> first_turns, second_turns;
  std::vector<int> first_kinds, second_kinds;
  std::vector<std::size_t> partner;  // of each first; kNone where there is none
  Pose2 second_from_first;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  FeatureSet first_set() const { return {first, first_turns, first_kinds}; }
  FeatureSet second_set() const { return {second, second_turns, second_kinds}; }
};

struct Shape {
  int common = 10;
  int extra = 5;  // on each side
  double sigma_m = 0.0;
  double size_m = 10.0;
};

Views make_views(const Shape& shape, Rng& rng) {
  Views views;
  views.second_from_first = {rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-3.1, 3.1)};
  const auto here = [&] { return Eigen::Vector2d(rng.uniform(0.0, shape.size_m), rng.uniform(0.0, 7.0)); };
  const auto noise = [&] { return Eigen::Vector2d(rng.normal(shape.sigma_m), rng.normal(shape.sigma_m)); };
  for (int k = 0; k < shape.common + shape.extra; ++k) {
    const Eigen::Vector2d at = here();
    const double turn = rng.uniform(-3.1, 3.1);
    const int kind = k % 2;
    views.first.push_back(at + noise());
    views.first_turns.push_back(turn);
    views.first_kinds.push_back(kind);
    const bool shared = k < shape.common;
    views.second.push_back(views.second_from_first * (shared ? at : here()) + noise());
    views.second_turns.push_back(
        wrap_angle((shared ? turn : rng.uniform(-3.1, 3.1)) + views.second_from_first.theta_rad));
    views.second_kinds.push_back(kind);
  }
  // Another order on the second side.
  views.partner.assign(views.first.size(), Views::kNone);
  std::vector<std::size_t> order(views.second.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t k = order.size(); k-- > 1;)
    std::swap(order[k], order[static_cast<std::size_t>(rng.uniform() * static_cast<double>(k + 1))]);
  const Views before = views;
  for (std::size_t k = 0; k < order.size(); ++k) {
    views.second[k] = before.second[order[k]];
    views.second_turns[k] = before.second_turns[order[k]];
    views.second_kinds[k] = before.second_kinds[order[k]];
    if (order[k] < static_cast<std::size_t>(shape.common)) views.partner[order[k]] = k;
  }
  return views;
}

void expect_one_to_one(const std::vector<FeaturePair>& pairs) {
  std::vector<std::size_t> firsts;
  std::vector<std::size_t> seconds;
  for (const FeaturePair& pair : pairs) {
    firsts.push_back(pair.first);
    seconds.push_back(pair.second);
  }
  EXPECT_TRUE(std::is_sorted(firsts.begin(), firsts.end()));
  std::sort(seconds.begin(), seconds.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
  EXPECT_EQ(std::adjacent_find(seconds.begin(), seconds.end()), seconds.end());
}

FeatureMatchConfig config_of(FeatureMatchMethod method) {
  FeatureMatchConfig config;
  config.method = method;
  return config;
}

std::string name_of(const testing::TestParamInfo<FeatureMatchMethod>& method) {
  constexpr const char* kNames[] = {"mutual_nearest", "ransac", "clique", "hough"};
  return kNames[static_cast<int>(method.param)];
}

class AnyMethod : public testing::TestWithParam<FeatureMatchMethod> {
 protected:
  /// All methods find their own way but the one that needs a guess.
  Pose2 guess(const Views& views) const {
    if (GetParam() != FeatureMatchMethod::mutual_nearest) return {};
    const Pose2& truth = views.second_from_first;
    return {truth.x_m + 0.02, truth.y_m - 0.03, truth.theta_rad + 0.005};
  }
  FeatureMatchConfig config() const {
    FeatureMatchConfig config = config_of(GetParam());
    if (GetParam() == FeatureMatchMethod::mutual_nearest) config.pairing.gate_m = 0.15;
    return config;
  }
};

TEST_P(AnyMethod, FindsThePairsAndTheExactPoseAmongStrangers) {
  Rng rng(1);
  int exact = 0;
  for (int run = 0; run < 40; ++run) {
    const Views views = make_views({.common = 8, .extra = 6}, rng);
    FeatureMatchConfig config = this->config();
    if (GetParam() != FeatureMatchMethod::mutual_nearest) config.pairing.sigma_m = 0.005;
    const auto match = match_features(views.first_set(), views.second_set(), config, {}, guess(views));
    ASSERT_EQ(match.result.status, MatchStatus::converged);
    expect_one_to_one(match.pairs);
    std::size_t right = 0;
    for (const FeaturePair& pair : match.pairs) right += views.partner[pair.first] == pair.second ? 1 : 0;
    // At a guess that is 4 cm off, a stranger may be nearer than the partner.
    EXPECT_GE(right, GetParam() == FeatureMatchMethod::mutual_nearest ? 7U : 8U) << run;
    // A stranger may lie within the gate by chance; without one the fit is exact.
    if (match.pairs.size() != 8 || right != 8) continue;
    ++exact;
    EXPECT_LT(distance_m(match.result.map_from_laser, views.second_from_first), 1e-9);
    EXPECT_LT(heading_difference_rad(match.result.map_from_laser, views.second_from_first), 1e-9);
    EXPECT_EQ(match.result.pair_count, 8);
    EXPECT_EQ(match.result.rank, 3);
  }
  EXPECT_GE(exact, 30);
}

TEST_P(AnyMethod, FindsThePoseWithoutOrientationsAndKinds) {
  Rng rng(2);
  int found = 0;
  for (int run = 0; run < 40; ++run) {
    const Views views = make_views({.common = 10, .extra = 4, .sigma_m = 0.01}, rng);
    FeatureMatchConfig config = this->config();
    config.pairing.sigma_m = 0.015;
    const auto match =
        match_features({.points = views.first}, {.points = views.second}, config, {}, guess(views));
    found += distance_m(match.result.map_from_laser, views.second_from_first) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(found, 39);
}

TEST_P(AnyMethod, CovarianceCoversTheErrors) {
  Rng rng(3);
  double nees = 0.0;
  const int runs = 300;
  for (int run = 0; run < runs; ++run) {
    const Views views = make_views({.common = 12, .extra = 0, .sigma_m = 0.03}, rng);
    const auto match = match_features(views.first_set(), views.second_set(), config(), {}, guess(views));
    ASSERT_TRUE(match.result.usable());
    const Pose2& pose = match.result.map_from_laser;
    const Eigen::Vector3d error(pose.x_m - views.second_from_first.x_m,
                                pose.y_m - views.second_from_first.y_m,
                                wrap_angle(pose.theta_rad - views.second_from_first.theta_rad));
    nees += error.dot(match.result.covariance.ldlt().solve(error)) / runs;
  }
  // 3 where the errors are Gaussian of the size told; the gate that cuts their tails and the weights that the
  // pairs get from their own residuals cost up to half of that.
  EXPECT_GT(nees, 2.0);
  EXPECT_LT(nees, 5.0);
}

TEST_P(AnyMethod, SaysTooFewPairsOfWhatHasNone) {
  Rng rng(4);
  const Views views = make_views({}, rng);
  const Pose2 guess{1, 2, 0.5};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector2d> odd{{nan, 1}, {2, nan}, {nan, nan}};
  const std::vector<Eigen::Vector2d> one_place(5, Eigen::Vector2d(1, 1));
  const std::vector<Eigen::Vector2d> one(1, Eigen::Vector2d(1, 1));
  for (const FeatureSet& first :
       {FeatureSet{}, FeatureSet{.points = odd}, FeatureSet{.points = one_place}, FeatureSet{.points = one}})
    for (const FeatureSet& second : {FeatureSet{}, views.second_set(), FeatureSet{.points = one_place}}) {
      const auto match = match_features(first, second, config(), {}, guess);
      EXPECT_EQ(match.result.status, MatchStatus::too_few_pairs);
      EXPECT_EQ(match.result.map_from_laser, guess);
      EXPECT_TRUE(match.result.covariance.allFinite());
    }
}

TEST_P(AnyMethod, GivesTheSameBitsTwiceAndFollowsTheOrderOfTheFeatures) {
  Rng rng(5);
  const Views views = make_views({.common = 9, .extra = 3, .sigma_m = 0.01}, rng);
  const auto match = match_features(views.first_set(), views.second_set(), config(), {}, guess(views));
  const auto again = match_features(views.first_set(), views.second_set(), config(), {}, guess(views));
  EXPECT_EQ(match.pairs, again.pairs);
  EXPECT_EQ(match.result.map_from_laser, again.result.map_from_laser);

  Views reversed = views;
  std::reverse(reversed.first.begin(), reversed.first.end());
  std::reverse(reversed.first_turns.begin(), reversed.first_turns.end());
  std::reverse(reversed.first_kinds.begin(), reversed.first_kinds.end());
  const auto other = match_features(reversed.first_set(), views.second_set(), config(), {}, guess(views));
  ASSERT_EQ(other.pairs.size(), match.pairs.size());
  const std::size_t last = views.first.size() - 1;
  for (std::size_t k = 0; k < match.pairs.size(); ++k) {
    const FeaturePair& there = other.pairs[match.pairs.size() - 1 - k];
    EXPECT_EQ(match.pairs[k].first, last - there.first);
    EXPECT_EQ(match.pairs[k].second, there.second);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, AnyMethod,
                         testing::Values(FeatureMatchMethod::mutual_nearest, FeatureMatchMethod::ransac,
                                         FeatureMatchMethod::clique, FeatureMatchMethod::hough),
                         name_of);

TEST(CandidatePairs, PassKindGateAndLook) {
  const std::vector<Eigen::Vector2d> first{{0, 0}, {1, 0}};
  const std::vector<Eigen::Vector2d> second{{0, 0.1}, {1, 0.3}, {5, 5}};
  const std::vector<int> kinds_of_first{1, 2};
  const std::vector<int> kinds_of_second{1, 1, 2};
  std::vector<FeaturePair> pairs;
  candidate_pairs({.points = first}, {.points = second}, {}, {}, {}, pairs);
  EXPECT_EQ(pairs.size(), 6U);
  candidate_pairs({.points = first, .kinds = kinds_of_first}, {.points = second, .kinds = kinds_of_second},
                  {}, {}, {}, pairs);
  EXPECT_EQ(pairs.size(), 3U);
  PairingConfig config;
  config.gate_m = 0.5;
  candidate_pairs({.points = first}, {.points = second}, {}, {}, config, pairs);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].second, 0U);
  EXPECT_EQ(pairs[1].second, 1U);
  config.gate_m = 0.0;
  const std::vector<float> distances{0.1F, 0.5F, 0.4F, 0.39F, 0.41F, 1.0F};
  candidate_pairs({.points = first}, {.points = second}, distances, {}, config, pairs);
  ASSERT_EQ(pairs.size(), 2U);  // 0.4F is a hair above 0.4
  EXPECT_EQ(pairs[1].first, 1U);
  config.max_descriptor_distance = 1.0;
  config.max_candidates = 3;
  candidate_pairs({.points = first}, {.points = second}, distances, {}, config, pairs);
  ASSERT_EQ(pairs.size(), 3U);  // 0.1, 0.4 and 0.39
  EXPECT_EQ(pairs[0].second, 0U);
  EXPECT_EQ(pairs[1].second, 2U);
  EXPECT_EQ(pairs[2].first, 1U);
}

TEST(MutualNearest, OneToOneAndNoneWhereTwoAreEqual) {
  MutualNearestScratch scratch;
  std::vector<FeaturePair> out;
  find_mutual_nearest(std::vector<FeaturePair>{{0, 0, 1.0}, {0, 1, 2.0}, {1, 0, 0.5}, {1, 1, 3.0}}, scratch,
                      out);
  EXPECT_EQ(out, (std::vector<FeaturePair>{{1, 0, 0.5}}));  // 0 would take 0, who prefers 1
  find_mutual_nearest(std::vector<FeaturePair>{{0, 0, 1.0}, {0, 1, 1.0}, {2, 3, 4.0}}, scratch, out);
  EXPECT_EQ(out, (std::vector<FeaturePair>{{2, 3, 4.0}}));
  find_mutual_nearest({}, scratch, out);
  EXPECT_TRUE(out.empty());
}

TEST(PairAgreement, IsTheChiSquareTestOfTheLengthsAndAChiSquareItIs) {
  Rng rng(6);
  const double sigma_m = 0.02;
  PairingConfig config;
  config.sigma_m = sigma_m;
  int agreed = 0;
  const int runs = 20000;
  for (int run = 0; run < runs; ++run) {
    const auto noise = [&] { return Eigen::Vector2d(rng.normal(sigma_m), rng.normal(sigma_m)); };
    const Eigen::Vector2d b(rng.uniform(2.0, 6.0), rng.uniform(-3.0, 3.0));
    const std::vector<Eigen::Vector2d> first{noise(), b + noise()};
    const std::vector<Eigen::Vector2d> second{noise(), b + noise()};
    agreed += PairAgreement({.points = first}, {.points = second}, config).agree({0, 0}, {1, 1}) ? 1 : 0;
  }
  // d1² - d2² has variance 8 σ² (d1² + d2²) / 2 a side: 95 % of the right pairs must pass, and more only by
  // as much as the test is wide.
  EXPECT_GT(agreed, 0.94 * runs);
  EXPECT_LT(agreed, 0.96 * runs);
  const std::vector<Eigen::Vector2d> line{{0, 0}, {3, 0}, {3, 0}};
  const std::vector<double> turns{0.0, 1.0, 0.0};
  const PairAgreement agreement({line, turns}, {line, turns}, config);
  EXPECT_TRUE(agreement.agree({0, 0}, {1, 1}));
  EXPECT_FALSE(agreement.agree({0, 0}, {0, 1}));  // one feature twice
  EXPECT_FALSE(agreement.agree({0, 0}, {1, 2}));  // turned
  EXPECT_FALSE(agreement.agree({0, 1}, {1, 0}));  // the line turns by 180°, the features by 57°
}

TEST(RansacPairs, ScoresNearlyAsWellAsTheBestOfAllHypotheses) {
  Rng rng(7);
  for (int run = 0; run < 30; ++run) {
    const Views views = make_views({.common = 6, .extra = 3, .sigma_m = 0.02}, rng);
    const FeatureSet first = views.first_set();
    const FeatureSet second = views.second_set();
    const PairingConfig pairing;
    std::vector<FeaturePair> candidates;
    candidate_pairs(first, second, {}, {}, pairing, candidates);
    const PairAgreement agreement(first, second, pairing);
    double best = 1.0;
    for (const FeaturePair& a : candidates)
      for (const FeaturePair& b : candidates) {
        if (!agreement.agree(a, b)) continue;
        RigidFit fit;
        fit.add(first.points[a.first], second.points[a.second]);
        fit.add(first.points[b.first], second.points[b.second]);
        best = std::min(best, score_pose(first, second, candidates, *fit.solve(), pairing));
      }
    RansacPairsConfig config;
    config.confidence = 0.999999;
    config.max_draws = 1'000'000;
    const auto pose = find_ransac_pose(first, second, candidates, pairing, config);
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->certain);
    EXPECT_GE(pose->score, best - 1e-12);
    // It stops when one right draw is certain, not when all are drawn; another right draw differs by the
    // noise.
    EXPECT_LT(pose->score, best + 0.2);
    EXPECT_EQ(pose->score, score_pose(first, second, candidates, pose->second_from_first, pairing));
  }
}

TEST(RansacPairs, SaysWhenItCouldNotDrawEnough) {
  Rng rng(8);
  const Views views = make_views({.common = 5, .extra = 30}, rng);
  auto config = config_of(FeatureMatchMethod::ransac);
  config.ransac.max_draws = 3000;
  const auto match = match_features({.points = views.first}, {.points = views.second}, config);
  EXPECT_NE(match.result.status, MatchStatus::converged);
}

TEST(CliquePairs, SayWhenTheLimitEndedTheSearch) {
  Rng rng(9);
  const Views views = make_views({.common = 12, .extra = 12, .sigma_m = 0.05, .size_m = 4.0}, rng);
  auto config = config_of(FeatureMatchMethod::clique);
  config.clique.node_limit = 20;
  config.pairing.max_chance = 1e12;
  config.pairing.sigma_m = 0.1;
  EXPECT_EQ(match_features({.points = views.first}, {.points = views.second}, config).result.status,
            MatchStatus::max_iterations);
}

TEST(PairsByChance, AreRefusedAndRightOnesAreNot) {
  Rng rng(11);
  for (const auto method :
       {FeatureMatchMethod::ransac, FeatureMatchMethod::clique, FeatureMatchMethod::hough}) {
    int believed = 0;
    int met = 0;
    int found = 0;
    for (int run = 0; run < 60; ++run) {
      auto config = config_of(method);
      const Views strangers = make_views({.common = 0, .extra = 15}, rng);
      believed +=
          match_features({.points = strangers.first}, {.points = strangers.second}, config).result.usable()
              ? 1
              : 0;
      config.pairing.max_chance = 1e12;
      met += match_features({.points = strangers.first}, {.points = strangers.second}, config).result.usable()
                 ? 1
                 : 0;
      const Views friends = make_views({.common = 9, .extra = 6, .sigma_m = 0.01}, rng);
      found += match_features({.points = friends.first}, {.points = friends.second}).result.usable() ? 1 : 0;
    }
    EXPECT_LE(believed, 6);  // fewer than max_chance, 1, a match: the bound is wide
    EXPECT_GE(met, 15);      // chance does find three pairs
    EXPECT_GE(found, 58);
  }
}

TEST(PairsByChance, FallWithEveryPairAndGrowWithTheCandidates) {
  Rng rng(12);
  const Views views = make_views({}, rng);
  const PairingConfig config;
  const auto chance = [&](std::size_t candidates, std::size_t pairs) {
    return pairs_by_chance(views.first_set(), views.second_set(), candidates, pairs, config);
  };
  // 15 features a side; two pairs are what a pose is made of and say nothing.
  EXPECT_DOUBLE_EQ(chance(100, 2), 0.5 * 100 * 100);
  for (std::size_t pairs = 4; pairs <= 15; ++pairs) EXPECT_LT(chance(100, pairs), chance(100, pairs - 1));
  EXPECT_LT(chance(100, 6), chance(200, 6));
  EXPECT_GT(pairs_by_chance({.points = views.first}, {.points = views.second}, 100, 6, config),
            chance(100, 6));
  EXPECT_EQ(pairs_by_chance({}, {}, 0, 0, config), 0.0);
}

TEST(HoughPose, KnowsNoLimitsOfPlaceAndHeadingAndKeepsNothing) {
  Rng rng(10);
  HoughScratch scratch;
  const PairingConfig pairing;
  std::vector<FeaturePair> candidates;
  for (const double turn : {-kPi, -0.001, 0.0, 0.001, 2.0, kPi - 1e-6}) {
    Views views = make_views({.common = 8, .extra = 2}, rng);
    const Pose2 far = Pose2{-250.0, 730.0, turn} * views.second_from_first.inverse();
    for (Eigen::Vector2d& point : views.second) point = far * point;
    candidate_pairs({.points = views.first}, {.points = views.second}, {}, {}, pairing, candidates);
    const auto find = [&](HoughScratch& in) {
      return find_hough_pose({.points = views.first}, {.points = views.second}, candidates, pairing, {}, in);
    };
    const auto pose = find(scratch);
    ASSERT_TRUE(pose);
    EXPECT_LT(distance_m(pose->second_from_first, {-250.0, 730.0, turn}), 0.05);
    EXPECT_LT(heading_difference_rad(pose->second_from_first, {0, 0, turn}), 0.005);
    HoughScratch fresh;
    EXPECT_EQ(find(fresh)->second_from_first, pose->second_from_first);
  }
}

}  // namespace
}  // namespace beaconless
