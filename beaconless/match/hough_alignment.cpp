// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hough_alignment.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

using Bin = HoughScratch::Bin;

void add(Bin& bin, const Bin& more) {
  bin.votes += more.votes;
  bin.cos += more.cos;
  bin.sin += more.sin;
}

/// Every two candidates that agree vote for the turn of the line between them.
void vote(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> candidates,
          const PairingConfig& pairing, const HoughConfig& config, std::vector<Bin>& bins) {
  const PairAgreement agreement(first, second, pairing);
  const auto count = static_cast<double>(bins.size());
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size(); ++b) {
      if (!agreement.agree(candidates[a], candidates[b])) continue;
      const Eigen::Vector2d p = first.points[candidates[b].first] - first.points[candidates[a].first];
      const Eigen::Vector2d q = second.points[candidates[b].second] - second.points[candidates[a].second];
      const double length_m2 = p.norm() * q.norm();
      if (!(length_m2 >= config.shortest_m * config.shortest_m)) continue;
      const double cos = p.dot(q) / length_m2;
      const double sin = (p.x() * q.y() - p.y() * q.x()) / length_m2;
      const double turn = (std::atan2(sin, cos) + kPi) / (2.0 * kPi);
      const auto bin = static_cast<std::size_t>(turn * count);
      add(bins[std::min(bin, bins.size() - 1)], {1.0, cos, sin});
    }
}

/// The headings that got most votes, neighbours counted with them, best first.
void find_peaks(const std::vector<Bin>& bins, int most, std::vector<Bin>& smoothed,
                std::vector<std::size_t>& peaks) {
  const std::size_t count = bins.size();
  smoothed.assign(bins.begin(), bins.end());
  peaks.clear();
  peaks.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    add(smoothed[k], bins[(k + 1) % count]);
    add(smoothed[k], bins[(k + count - 1) % count]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double here = smoothed[k].votes;
    // Of a plateau the first bin is the peak.
    if (here > 0.0 && here > smoothed[(k + count - 1) % count].votes &&
        here >= smoothed[(k + 1) % count].votes)
      peaks.push_back(k);
  }
  std::sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) {
    return smoothed[a].votes > smoothed[b].votes || (smoothed[a].votes == smoothed[b].votes && a < b);
  });
  peaks.resize(std::min(peaks.size(), static_cast<std::size_t>(most)));
}

/// The mean of the shifts around the one that has most others within `reach_m`.
Eigen::Vector2d densest(std::vector<HoughScratch::Shift>& shifts, double reach_m) {
  std::sort(shifts.begin(), shifts.end(),
            [](const auto& a, const auto& b) { return a.x_m < b.x_m || (a.x_m == b.x_m && a.y_m < b.y_m); });
  std::size_t most = 0;
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  std::size_t begin = 0;
  for (const auto& centre : shifts) {
    while (shifts[begin].x_m < centre.x_m - reach_m) ++begin;
    std::size_t near = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = begin; k < shifts.size() && shifts[k].x_m <= centre.x_m + reach_m; ++k) {
      const Eigen::Vector2d shift(shifts[k].x_m, shifts[k].y_m);
      if ((shift - Eigen::Vector2d(centre.x_m, centre.y_m)).squaredNorm() > reach_m * reach_m) continue;
      ++near;
      sum += shift;
    }
    if (near <= most) continue;
    most = near;
    best = sum / static_cast<double>(near);
  }
  return best;
}

}  // namespace

void describe(Fields& fields, HoughConfig& config) {
  fields("bin_rad", config.bin_rad, {1e-4, 0.5}, "width of a bin of the headings");
  fields("shortest_m", config.shortest_m, {0.01, 100.0},
         "lines between features shorter than this do not vote for a heading");
  fields("peaks", config.peaks, {1, 1000}, "headings that are tried");
}

std::optional<PairsPose> find_hough_pose(const FeatureSet& first, const FeatureSet& second,
                                         std::span<const FeaturePair> candidates,
                                         const PairingConfig& pairing, const HoughConfig& config,
                                         HoughScratch& scratch) {
  // 1. Headings.
  const double bins = std::max(8.0, std::round(2.0 * kPi / config.bin_rad));
  scratch.bins.assign(static_cast<std::size_t>(bins), Bin{});
  vote(first, second, candidates, pairing, config, scratch.bins);
  find_peaks(scratch.bins, config.peaks, scratch.smoothed, scratch.peaks);

  // 2. At each of the best, where most candidates would put the origin.
  const PairAgreement agreement(first, second, pairing);
  std::optional<PairsPose> best;
  for (const std::size_t peak : scratch.peaks) {
    const Pose2 turn{0.0, 0.0, std::atan2(scratch.smoothed[peak].sin, scratch.smoothed[peak].cos)};
    scratch.shifts.clear();
    scratch.shifts.reserve(candidates.size());
    for (const FeaturePair& pair : candidates) {
      if (!agreement.turns_like(pair, turn.theta_rad)) continue;
      const Eigen::Vector2d shift = second.points[pair.second] - turn * first.points[pair.first];
      scratch.shifts.push_back({shift.x(), shift.y()});
    }
    if (scratch.shifts.empty()) continue;
    const Eigen::Vector2d at = densest(scratch.shifts, std::sqrt(pairing.same_place_m2()));

    // 3. The pose that explains most.
    const Pose2 pose{at.x(), at.y(), turn.theta_rad};
    const double score = score_pose(first, second, candidates, pose, pairing);
    if (!best || score < best->score)
      best = PairsPose{.second_from_first = pose, .score = score, .certain = true};
  }
  return best;
}

}  // namespace beaconless
