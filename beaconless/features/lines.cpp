// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beaconless/features/line_ends.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// Everything a scan's lines are made from.
class LineFinder {
 public:
  LineFinder(const Scan& scan, const LinesConfig& config, LinesScratch& scratch)
      : scan_(scan), config_(config), scratch_(scratch), runs_(scratch.runs) {}

  void find(std::vector<ScanLine>& lines) {
    lines.clear();
    cut();
    if (scratch_.pieces.empty()) return;
    points_ = ordered_points(scan_, scratch_.pieces, scratch_.points);
    scratch_.sums.build(points_, config_.sigma_m, config_.weight);
    place_and_merge();
    if (config_.refine_passes > 0) absorb_short_runs(points_, scratch_.sums, config_, runs_);
    for (int pass = 0; pass < config_.refine_passes; ++pass) {
      move_ends(points_, scratch_.sums, config_, scratch_.lines, runs_);
      // Beams of the wrong wall may have been all that kept two pieces of one wall apart.
      if (pass == 0 && config_.is_merged) merge_runs(points_, scratch_.sums, merging(), runs_);
    }
    fit_all(lines);
  }

 private:
  /// 1. Segments, and straight pieces of them.
  void cut() {
    DistanceSegmentationConfig segmentation = config_.segmentation;
    segmentation.sigma_m = config_.sigma_m;
    if (!config_.is_segmented_first)
      segmentation = {.threshold = DistanceThreshold::constant, .constant_m = 1e9};
    segment_by_distance(scan_, segmentation, scratch_.segmentation, scratch_.segments);
    const SplitConfig splitting{.epsilon_m =
                                    std::max(config_.split_least_m, config_.split_sigma * config_.sigma_m)};
    split(scan_, scratch_.segments, splitting, scratch_.splitting, scratch_.pieces);
  }

  /// 2. Pieces with a direction of their own, joined where two are one.
  void place_and_merge() {
    runs_.clear();
    for (const ScanSegment& piece : scratch_.pieces) {
      const std::size_t first = points_.place_of(piece);
      if (piece.count >= 3) runs_.push_back({first, first + piece.count - 1});
    }
    if (config_.is_cut_again) cut_again();
    if (config_.is_merged) merge_runs(points_, scratch_.sums, merging(), runs_);
    std::erase_if(runs_, [this](PlaceRun run) { return hit_count(run) < config_.min_beams; });
  }

  MergeConfig merging() const {
    MergeConfig merging = config_.merging;
    merging.sigma_m = config_.sigma_m;
    return merging;
  }

  /// Bends too small for the split but too large for the noise.
  void cut_again() {
    const MergeConfig when = merging();
    std::swap(runs_, scratch_.uncut);
    runs_.clear();
    std::vector<PlaceRun>& todo = scratch_.uncut;
    std::reverse(todo.begin(), todo.end());
    while (!todo.empty()) {
      const PlaceRun run = todo.back();
      todo.pop_back();
      const std::size_t cut = best_cut(scratch_.sums, when, run);
      if (cut == run.last) {
        runs_.push_back(run);
      } else {
        todo.push_back({cut + 1, run.last});
        todo.push_back({run.first, cut});
      }
    }
  }

  int hit_count(PlaceRun run) const {
    return static_cast<int>(std::lround(scratch_.sums.of(run.first, run.last).count));
  }

  /// 3. What is long enough and met well enough.
  void fit_all(std::vector<ScanLine>& lines) {
    const double least_cosine = std::sin(radians(config_.least_incidence_deg));
    for (const PlaceRun& run : runs_) {
      const PointMoments sums = scratch_.sums.of(run.first, run.last);
      if (static_cast<int>(std::lround(sums.count)) < config_.min_beams) continue;
      const Eigen::Vector2d first = points_[run.first];
      const Eigen::Vector2d last = points_[run.last];
      if ((last - first).squaredNorm() < config_.min_length_m * config_.min_length_m) continue;
      const PrincipalLine line = principal_line(sums);
      const double nearest_square = std::min(first.squaredNorm(), last.squaredNorm());
      if (line.rho_m * line.rho_m < least_cosine * least_cosine * nearest_square) continue;

      const bool is_tls = config_.fit.method == LineFitMethod::tls;
      const auto fit =
          is_tls ? fit_line_tls(sums, line, scratch_.sums.unit_sigma_m(line, sums)) : fit_otherwise(run);
      if (!fit) continue;
      const Eigen::Vector2d normal = is_tls ? line.normal : fit->line.normal();
      const double rho = is_tls ? line.rho_m : fit->line.rho_m;
      lines.push_back({.beams = points_.segment_of(run.first, run.last),
                       .fit = *fit,
                       .a = first - (normal.dot(first) - rho) * normal,
                       .b = last - (normal.dot(last) - rho) * normal});
    }
  }

  std::optional<LineFit> fit_otherwise(PlaceRun run) {
    scratch_.run_points.clear();
    for (std::size_t i = run.first; i <= run.last; ++i)
      if (points_.is_hit(i)) scratch_.run_points.push_back(points_[i]);
    LineFitConfig fit = config_.fit;
    fit.sigma_m = config_.sigma_m;
    return fit_line(scratch_.run_points, fit, scratch_.fit);
  }

  const Scan& scan_;
  const LinesConfig& config_;
  LinesScratch& scratch_;
  std::vector<PlaceRun>& runs_;
  OrderedPoints points_;
};

}  // namespace

void describe(Fields& fields, LinesConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("is_segmented_first", config.is_segmented_first, "cut the scan at jumps before it is split");
  fields.section("segmentation", config.segmentation, {"sigma_m"});
  fields("split_sigma", config.split_sigma, {0.0, 1000.0},
         "points further than this many sigmas from a chord cut it");
  fields("split_least_m", config.split_least_m, {1e-6, 100.0}, "points nearer than this to a chord never do");
  fields("is_cut_again", config.is_cut_again, "cut lines again where two fit far better than one");
  fields("is_merged", config.is_merged, "join neighbours that one line explains as well");
  fields.section("merging", config.merging, {"sigma_m"});
  fields("refine_passes", config.refine_passes, {0, 10},
         "how often the ends of neighbours are moved to where their lines cross");
  fields("trim_sigma", config.trim_sigma, {1.0, 1000.0}, "end beams further from their line are left out");
  fields("min_beams", config.min_beams, {2, 1000000}, "lines of fewer beams are left out");
  fields("min_length_m", config.min_length_m, {0.0, 100.0}, "shorter lines are left out");
  fields("least_incidence_deg", config.least_incidence_deg, {0.0, 45.0},
         "lines that all beams meet at a lesser angle are left out");
  fields("weight", config.weight, {"uniform", "radial"}, "how much a beam counts in a line by tls");
  fields.section("fit", config.fit, {"sigma_m"});
}

void find_lines(const Scan& scan, const LinesConfig& config, LinesScratch& scratch,
                std::vector<ScanLine>& lines) {
  LineFinder(scan, config, scratch).find(lines);
}

std::vector<ScanLine> find_lines(const Scan& scan, const LinesConfig& config) {
  LinesScratch scratch;
  std::vector<ScanLine> lines;
  find_lines(scan, config, scratch, lines);
  return lines;
}

}  // namespace beaconless
