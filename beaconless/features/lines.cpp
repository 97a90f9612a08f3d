// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kSearch_beams = 12;  // how far the end of a line may be moved in one pass
constexpr std::size_t kMeeting_beams = 5;  // neighbours with no more than this between them meet
constexpr std::size_t kShort_beams = 20;   // longer pieces across a corner do not come from noise
constexpr double kLeastCrossing = 0.1;     // sine of the angle below which a crossing says little

double cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); }

/// The cosine of the incidence of a beam on a line, not below what is said of it in line_sums.hpp.
double cosine_at(const OrderedPoints& points, std::size_t at, const PrincipalLine& line) {
  return std::clamp(std::abs(line.rho_m) / static_cast<double>(points.ranges_m[at]), 0.1, 1.0);
}

std::optional<Eigen::Vector2d> crossing_of(const PrincipalLine& p, const PrincipalLine& q) {
  const double sine = cross(p.normal, q.normal);
  if (!(std::abs(sine) > kLeastCrossing)) return std::nullopt;
  return Eigen::Vector2d{(p.rho_m * q.normal.y() - q.rho_m * p.normal.y()) / sine,
                         (q.rho_m * p.normal.x() - p.rho_m * q.normal.x()) / sine};
}

/// Two runs that follow each other; the second may be the first one again, a turn further on.
struct Neighbours {
  PlaceRun& left;
  PlaceRun& right;
  std::size_t turn;  // added to the places of the right one

  bool meet() const { return right.first + turn <= left.last + kMeeting_beams + 1; }
};

/// The first place beyond the bearing of the crossing, next to where two runs meet; 0 where the crossing is
/// not there.
std::size_t first_beyond(const OrderedPoints& points, const Eigen::Vector2d& crossing,
                         const Neighbours& pair) {
  const std::size_t start = pair.right.first + pair.turn;
  const std::size_t low = std::max(pair.left.first + 2, start > kSearch_beams ? start - kSearch_beams : 0);
  const std::size_t high = std::min({pair.right.last + pair.turn, start + kSearch_beams, points.size()}) - 1;
  if (low >= high || crossing.dot(points[pair.left.last]) <= 0.0) return 0;
  std::size_t at = std::clamp(start, low, high);
  const auto is_beyond = [&](std::size_t i) { return cross(crossing, points[i]) > 0.0; };
  while (at > low && (!points.is_hit(at - 1) || is_beyond(at - 1))) --at;
  while (at < high && !is_beyond(at)) ++at;
  return at > low && at < high ? at : 0;
}

/// Whether a beam lies on a line, give or take its noise and what is usual on that line.
bool is_on(const OrderedPoints& points, std::size_t at, const DrawnLine& drawn, const LinesConfig& config) {
  if (!points.is_hit(at)) return false;
  const double across = config.sigma_m * cosine_at(points, at, drawn.line);
  const double most = config.trim_sigma * config.trim_sigma * std::max(across * across, drawn.mean_square_m2);
  const double distance = drawn.line.signed_distance_m(points[at]);
  return distance * distance <= most;
}

/// Parts two runs by the bearing at which their lines cross, as far as the beams lie on the line that they
/// are given to; where the lines do not cross near by, a beam that both own goes to the nearer one.
void part(const OrderedPoints& points, const DrawnLine& p, const DrawnLine& q, const LinesConfig& config,
          Neighbours pair) {
  if (!pair.meet()) return;
  std::size_t& last = pair.left.last;
  std::size_t first = pair.right.first + pair.turn;
  if (const auto crossing = crossing_of(p.line, q.line)) {
    if (const std::size_t beyond = first_beyond(points, *crossing, pair); beyond != 0) {
      if (last >= beyond) last = beyond - 1;
      if (first < beyond) first = beyond;
      while (last + 1 < beyond && is_on(points, last + 1, p, config)) ++last;
      while (first > beyond && is_on(points, first - 1, q, config)) --first;
      pair.right.first = first - pair.turn;
      return;
    }
  }
  if (last != first) return;
  const Eigen::Vector2d shared = points[last];
  if (std::abs(p.line.signed_distance_m(shared)) <= std::abs(q.line.signed_distance_m(shared)))
    ++pair.right.first;
  else
    --last;
}

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
    if (config_.refine_passes > 0) absorb();
    for (int pass = 0; pass < config_.refine_passes; ++pass) {
      refine();
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

  /// Short pieces across a corner, which the split leaves where noise hid the vertex: their beams go to the
  /// walls on either side where those explain them.
  void absorb() {
    std::size_t kept = 1;
    for (std::size_t i = 1; i + 1 < runs_.size(); ++i)
      if (!is_absorbed(runs_[kept - 1], runs_[i], runs_[i + 1])) runs_[kept++] = runs_[i];
    if (runs_.size() < 3) return;
    runs_[kept++] = runs_.back();
    runs_.resize(kept);
  }

  bool is_absorbed(PlaceRun& before, PlaceRun run, PlaceRun& after) const {
    const std::size_t count = run.last - run.first + 1;
    if (count > kShort_beams || run.first > before.last + kMeeting_beams + 1 ||
        after.first > run.last + kMeeting_beams + 1)
      return false;
    if (before.last - before.first < count || after.last - after.first < count) return false;
    const PrincipalLine p = line_of(before);
    const PrincipalLine q = line_of(after);
    const auto crossing = crossing_of(p, q);
    if (!crossing) return false;
    double chi_square = 0.0;
    std::size_t beyond = run.last + 1;
    for (std::size_t at = run.last + 1; at-- > run.first;) {
      if (!points_.is_hit(at)) continue;
      const bool is_before = cross(*crossing, points_[at]) <= 0.0;
      if (!is_before) beyond = at;
      const PrincipalLine& line = is_before ? p : q;
      const double across = config_.sigma_m * cosine_at(points_, at, line);
      const double distance = line.signed_distance_m(points_[at]) / across;
      chi_square += distance * distance;
    }
    const auto n = static_cast<double>(count);
    if (chi_square > n + config_.trim_sigma * std::sqrt(2.0 * n)) return false;
    before.last = std::max(before.last, beyond - 1);
    after.first = std::min(after.first, beyond);
    return true;
  }

  PrincipalLine line_of(PlaceRun run) const { return principal_line(scratch_.sums.of(run.first, run.last)); }

  /// 3. Ends to where neighbours cross, then off the beams that lie on neither.
  void refine() {
    if (runs_.empty()) return;
    std::vector<DrawnLine>& drawn = scratch_.lines;
    drawn.clear();
    for (const PlaceRun& run : runs_) {
      const PointMoments sums = scratch_.sums.of(run.first, run.last);
      const PrincipalLine line = principal_line(sums);
      drawn.push_back({line, sums.weight > 0.0 ? line.across_square / sums.weight : 0.0});
    }
    for (std::size_t i = 0; i + 1 < runs_.size(); ++i)
      part(points_, drawn[i], drawn[i + 1], config_, {runs_[i], runs_[i + 1], 0});
    if (points_.is_circle && runs_.size() > 1)
      part(points_, drawn.back(), drawn.front(), config_, {runs_.back(), runs_.front(), points_.beam_count});
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      PlaceRun& run = runs_[i];
      while (run.last > run.first + 2 && !is_on(points_, run.last, drawn[i], config_)) --run.last;
      while (run.last > run.first + 2 && !is_on(points_, run.first, drawn[i], config_)) ++run.first;
    }
  }

  /// 4. What is long enough and met well enough.
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
  fields.section("segmentation", config.segmentation);
  fields("split_sigma", config.split_sigma, {0.0, 1000.0},
         "points further than this many sigmas from a chord cut it");
  fields("split_least_m", config.split_least_m, {1e-6, 100.0}, "points nearer than this to a chord never do");
  fields("is_cut_again", config.is_cut_again, "cut lines again where two fit far better than one");
  fields("is_merged", config.is_merged, "join neighbours that one line explains as well");
  fields.section("merging", config.merging);
  fields("refine_passes", config.refine_passes, {0, 10},
         "how often the ends of neighbours are moved to where their lines cross");
  fields("trim_sigma", config.trim_sigma, {1.0, 1000.0}, "end beams further from their line are left out");
  fields("min_beams", config.min_beams, {2, 1000000}, "lines of fewer beams are left out");
  fields("min_length_m", config.min_length_m, {0.0, 100.0}, "shorter lines are left out");
  fields("least_incidence_deg", config.least_incidence_deg, {0.0, 45.0},
         "lines that all beams meet at a lesser angle are left out");
  fields("weight", config.weight, {"uniform", "radial"}, "how much a beam counts in a line by tls");
  fields.section("fit", config.fit);
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
