// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/line_ends.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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
  if (const auto meeting = crossing(p.line, q.line, kLeastCrossing)) {
    if (const std::size_t beyond = first_beyond(points, *meeting, pair); beyond != 0) {
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

PrincipalLine line_of(const LineSums& sums, PlaceRun run) {
  return principal_line(sums.of(run.first, run.last));
}

/// Gives the beams of a short run to its neighbours, whose lines cross within it, where those explain them.
bool is_absorbed(const OrderedPoints& points, const LineSums& sums, const LinesConfig& config,
                 PlaceRun& before, PlaceRun run, PlaceRun& after) {
  const std::size_t count = run.last - run.first + 1;
  if (count > kShort_beams || run.first > before.last + kMeeting_beams + 1 ||
      after.first > run.last + kMeeting_beams + 1)
    return false;
  if (before.last - before.first < count || after.last - after.first < count) return false;
  const PrincipalLine p = line_of(sums, before);
  const PrincipalLine q = line_of(sums, after);
  const auto meeting = crossing(p, q, kLeastCrossing);
  if (!meeting) return false;
  double chi_square = 0.0;
  std::size_t beyond = run.last + 1;
  for (std::size_t at = run.last + 1; at-- > run.first;) {
    if (!points.is_hit(at)) continue;
    const bool is_before = cross(*meeting, points[at]) <= 0.0;
    if (!is_before) beyond = at;
    const PrincipalLine& line = is_before ? p : q;
    const double distance =
        line.signed_distance_m(points[at]) / (config.sigma_m * cosine_at(points, at, line));
    chi_square += distance * distance;
  }
  const auto n = static_cast<double>(count);
  if (chi_square > n + config.trim_sigma * std::sqrt(2.0 * n)) return false;
  before.last = std::max(before.last, beyond - 1);
  after.first = std::min(after.first, beyond);
  return true;
}

}  // namespace

void absorb_short_runs(const OrderedPoints& points, const LineSums& sums, const LinesConfig& config,
                       std::vector<PlaceRun>& runs) {
  if (runs.size() < 3) return;
  std::size_t kept = 1;
  for (std::size_t i = 1; i + 1 < runs.size(); ++i)
    if (!is_absorbed(points, sums, config, runs[kept - 1], runs[i], runs[i + 1])) runs[kept++] = runs[i];
  runs[kept++] = runs.back();
  runs.resize(kept);
}

void move_ends(const OrderedPoints& points, const LineSums& sums, const LinesConfig& config,
               std::vector<DrawnLine>& drawn, std::vector<PlaceRun>& runs) {
  // 1. The lines as they are, so that no end depends on the order in which they are moved.
  if (runs.empty()) return;
  drawn.clear();
  for (const PlaceRun& run : runs) {
    const PointMoments moments = sums.of(run.first, run.last);
    const PrincipalLine line = principal_line(moments);
    drawn.push_back({line, moments.weight > 0.0 ? line.across_square / moments.weight : 0.0});
  }
  // 2. To where neighbours cross.
  for (std::size_t i = 0; i + 1 < runs.size(); ++i)
    part(points, drawn[i], drawn[i + 1], config, {runs[i], runs[i + 1], 0});
  if (points.is_circle && runs.size() > 1)
    part(points, drawn.back(), drawn.front(), config, {runs.back(), runs.front(), points.beam_count});
  // 3. Off the beams that lie on neither.
  for (std::size_t i = 0; i < runs.size(); ++i) {
    PlaceRun& run = runs[i];
    while (run.last > run.first + 2 && !is_on(points, run.last, drawn[i], config)) --run.last;
    while (run.last > run.first + 2 && !is_on(points, run.first, drawn[i], config)) ++run.first;
  }
}

}  // namespace beaconless
