// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/merge.hpp"

#include <algorithm>

namespace beaconless {
namespace {

// Residuals beyond sigma loosen the test up to here; more is a bend and not a rough wall.
constexpr double kRoughest = 4.0;
constexpr double kCutAgain =
    1.5;  // a cut is the best of many, so more must speak for it than for two pieces met
constexpr std::size_t kLooks = 10;  // for the best cut, before it is narrowed down

struct Judged {
  double chi_square = 0.0;
  double freedom = 0.0;
};

Judged judge(const LineSums& sums, const PointMoments& moments) {
  if (moments.count < 3.0) return {};
  return {sums.chi_square(moments), moments.count - 2.0};
}

/// By how much chi² of two fits may be below that of one before they are two lines.
double most_excess(const MergeConfig& config, const Judged& left, const Judged& right) {
  const double apart = left.chi_square + right.chi_square;
  const double rough = apart / std::max(1.0, left.freedom + right.freedom);
  return config.chi_square * std::clamp(rough, 1.0, kRoughest);
}

bool are_one_line(const LineSums& sums, const MergeConfig& config, PlaceRun p, PlaceRun q) {
  const Judged one = judge(sums, sums.of(p.first, q.last));
  const Judged left = judge(sums, sums.of(p.first, p.last));
  const Judged right = judge(sums, sums.of(q.first, q.last));
  return one.chi_square - left.chi_square - right.chi_square <= most_excess(config, left, right);
}

}  // namespace

void describe(Fields& fields, MergeConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("chi_square", config.chi_square, {0.0, 1e6},
         "two pieces are one line unless that fits worse by more than this");
  fields("bridge_beams", config.bridge_beams, {0, 1000}, "most beams between two pieces of one line");
}

std::size_t best_cut(const LineSums& sums, const MergeConfig& config, PlaceRun run) {
  const Judged one = judge(sums, sums.of(run.first, run.last));
  if (one.chi_square - one.freedom <= kCutAgain * config.chi_square) return run.last;
  std::size_t best = run.last;
  double most = 0.0;
  const auto look_at = [&](std::size_t cut) {
    const Judged left = judge(sums, sums.of(run.first, cut));
    const Judged right = judge(sums, sums.of(cut + 1, run.last));
    const double excess = one.chi_square - left.chi_square - right.chi_square;
    const double over = excess - kCutAgain * most_excess(config, left, right);
    if (over <= most) return;
    most = over;
    best = cut;
  };
  // 1. A look all along, and at each of the beams next to the ends, where one that is off has no neighbours.
  const std::size_t beams = run.last - run.first;
  std::size_t step = std::max<std::size_t>(1, beams / kLooks);
  for (std::size_t cut = run.first; cut < run.last; cut += step) look_at(cut);
  for (std::size_t k = 1; k < std::min<std::size_t>(4, step); ++k) {
    look_at(run.first + k);
    look_at(run.last - k);
  }
  // 2. Closer and closer around the best.
  while (best != run.last && step > 1) {
    step = (step + 1) / 2;
    const std::size_t around = best;
    if (around >= run.first + step) look_at(around - step);
    if (around + step < run.last) look_at(around + step);
  }
  return best;
}

void merge_runs(const OrderedPoints& points, const LineSums& sums, const MergeConfig& config,
                std::vector<PlaceRun>& runs) {
  if (runs.empty()) return;
  // 1. From left to right onto the last one kept.
  const std::size_t reach = static_cast<std::size_t>(std::max(0, config.bridge_beams)) + 1;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const PlaceRun next = runs[i];
    if (next.first <= runs[kept].last + reach && are_one_line(sums, config, runs[kept], next))
      runs[kept].last = next.last;
    else
      runs[++kept] = next;
  }
  runs.resize(kept + 1);

  // 2. Over the end of a full circle: the head stands once more a turn further on.
  if (!points.is_circle || kept == 0) return;
  const PlaceRun head{runs.front().first + points.beam_count, runs.front().last + points.beam_count};
  PlaceRun& tail = runs.back();
  if (head.first > tail.last + reach || head.last >= points.size()) return;
  if (!are_one_line(sums, config, tail, head)) return;
  tail.last = head.last;
  runs.erase(runs.begin());
}

void merge(const Scan& scan, std::span<const ScanSegment> pieces, const MergeConfig& config,
           MergeScratch& scratch, std::vector<ScanSegment>& merged) {
  merged.clear();
  if (pieces.empty()) return;
  const OrderedPoints points = ordered_points(scan, pieces, scratch.points);
  scratch.sums.build(points, config.sigma_m, BeamWeight::radial);
  scratch.runs.clear();
  for (const ScanSegment& piece : pieces) {
    if (piece.count == 0) continue;
    const std::size_t first = points.place_of(piece);
    scratch.runs.push_back({first, first + piece.count - 1});
  }
  merge_runs(points, scratch.sums, config, scratch.runs);
  for (const PlaceRun& run : scratch.runs) merged.push_back(points.segment_of(run.first, run.last));
}

std::vector<ScanSegment> merge(const Scan& scan, std::span<const ScanSegment> pieces,
                               const MergeConfig& config) {
  MergeScratch scratch;
  std::vector<ScanSegment> merged;
  merge(scan, pieces, config, scratch, merged);
  return merged;
}

}  // namespace beaconless
