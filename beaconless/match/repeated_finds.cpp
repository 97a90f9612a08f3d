// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/repeated_finds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_buckets.hpp"
#include "beaconless/match/views_in_sight.hpp"

namespace beaconless {
namespace {

constexpr int kShifts = 20;
constexpr double kArrived_share = 0.005;  // of the radius
constexpr double kSettled_share = 0.75;   // finds this near to a mode need no climb of their own …
constexpr double kPassed_share = 0.25;    // … nor do those this near to a climb's way
constexpr double kOutlier_sigma = 2.5;
constexpr double kLeastSpread_m = 1e-3;     // finds this near to the mean are no outliers
constexpr double kUsualRange_share = 0.75;  // of the finds are no farther than a view that should see one

/// A place where finds are dense.
struct Mode {
  Eigen::Vector2d point;
  double orientation_rad;
  int views;
};

class Finds {
 public:
  Finds(std::span<const MapFind> finds, std::size_t view_count, const RepeatedFindsConfig& config)
      : finds_(finds),
        radius_m_(config.same_place_m),
        turn_rad_(radians(config.same_turn_deg)),
        near_(points_of(finds), config.same_place_m),
        counted_(view_count, 0) {}

  bool alike(double a_rad, double b_rad) const { return std::abs(wrap_angle(a_rad - b_rad)) <= turn_rad_; }

  template <class Visit>
  void for_each_alike(const Mode& mode, double radius_m, Visit&& visit) const {
    near_.for_each_within(mode.point, radius_m, [&](std::size_t i) {
      if (alike(finds_[i].feature.orientation_rad, mode.orientation_rad)) visit(i);
    });
  }

  /// Climbs from a find to where finds are densest around it.
  Mode climb(std::size_t from, std::vector<bool>& settled) const {
    Mode mode{finds_[from].feature.point, finds_[from].feature.orientation_rad, 0};
    settled[from] = true;
    for (int shift = 0; shift < kShifts; ++shift) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      Eigen::Vector2d direction = Eigen::Vector2d::Zero();
      int count = 0;
      for_each_alike(mode, radius_m_, [&](std::size_t i) {
        const PointFeature& feature = finds_[i].feature;
        if ((feature.point - mode.point).norm() <= kPassed_share * radius_m_) settled[i] = true;
        sum += feature.point;
        direction += Eigen::Vector2d(std::cos(feature.orientation_rad), std::sin(feature.orientation_rad));
        ++count;
      });
      if (count == 0) break;
      const Eigen::Vector2d mean = sum / count;
      const double moved = (mean - mode.point).norm();
      mode.point = mean;
      if (direction.norm() > 1e-9)
        mode.orientation_rad = wrap_angle(std::atan2(direction.y(), direction.x()));
      if (moved < kArrived_share * radius_m_) break;
    }
    return mode;
  }

  int count_views(const Mode& mode) {
    ++count_;
    int views = 0;
    for_each_alike(mode, radius_m_, [&](std::size_t i) {
      std::uint32_t& last = counted_[static_cast<std::size_t>(finds_[i].view)];
      views += last != count_ ? 1 : 0;
      last = count_;
    });
    return views;
  }

  double radius_m() const { return radius_m_; }
  const MapFind& operator[](std::size_t i) const { return finds_[i]; }
  std::size_t size() const { return finds_.size(); }

 private:
  static std::vector<Eigen::Vector2d> points_of(std::span<const MapFind> finds) {
    std::vector<Eigen::Vector2d> points;
    points.reserve(finds.size());
    for (const MapFind& find : finds) points.push_back(find.feature.point);
    return points;
  }

  std::span<const MapFind> finds_;
  double radius_m_;
  double turn_rad_;
  PointBuckets near_;
  std::vector<std::uint32_t> counted_;  // per view: the last count that it was in
  std::uint32_t count_ = 0;
};

/// The modes with enough views, those of most views first, none within reach of a better one like it.
std::vector<Mode> find_modes(Finds& finds, int min_views) {
  std::vector<Mode> modes;
  std::vector<bool> settled(finds.size(), false);
  for (std::size_t i = 0; i < finds.size(); ++i) {
    if (settled[i]) continue;
    Mode mode = finds.climb(i, settled);
    finds.for_each_alike(mode, kSettled_share * finds.radius_m(), [&](std::size_t j) { settled[j] = true; });
    mode.views = finds.count_views(mode);
    if (mode.views >= min_views) modes.push_back(mode);
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& p, const Mode& q) { return p.views > q.views; });
  std::vector<Mode> best;
  for (const Mode& mode : modes) {
    const bool taken = std::any_of(best.begin(), best.end(), [&](const Mode& other) {
      return (other.point - mode.point).norm() <= finds.radius_m() &&
             finds.alike(other.orientation_rad, mode.orientation_rad);
    });
    if (!taken) best.push_back(mode);
  }
  return best;
}

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Mean and scatter of finds, once more without those far out.
RepeatedFind summary(const Finds& finds, std::vector<std::size_t>& members) {
  RepeatedFind found;
  PointFeature& feature = found.feature;
  for (int pass = 0; pass < 2; ++pass) {
    const auto count = static_cast<double>(members.size());
    feature = {};
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();
    for (const std::size_t i : members) {
      const PointFeature& find = finds[i].feature;
      feature.point += find.point / count;
      feature.opening_rad += find.opening_rad / count;
      direction += Eigen::Vector2d(std::cos(find.orientation_rad), std::sin(find.orientation_rad));
    }
    feature.orientation_rad = wrap_angle(std::atan2(direction.y(), direction.x()));
    for (const std::size_t i : members) {
      const Eigen::Vector2d off = finds[i].feature.point - feature.point;
      feature.covariance += off * off.transpose() / count;
    }
    found.evidence.scatter_m = std::sqrt(feature.covariance.trace());
    const double most = std::max(kLeastSpread_m, kOutlier_sigma * found.evidence.scatter_m);
    std::erase_if(members,
                  [&](std::size_t i) { return (finds[i].feature.point - feature.point).norm() > most; });
  }
  return found;
}

}  // namespace

void describe(Fields& fields, RepeatedFindsConfig& config) {
  fields("same_place_m", config.same_place_m, {0.005, 1.0},
         "finds within this distance of their mean are one feature");
  fields("same_turn_deg", config.same_turn_deg, {1.0, 180.0}, "… if they are turned alike to within this");
  fields("min_views", config.min_views, {1, 10000}, "features found in fewer views are left out");
  fields("min_share", config.min_share, {0.0, 1.0},
         "features found in a smaller share of the views that see their place are left out");
  fields("max_scatter_m", config.max_scatter_m, {0.0, 1.0},
         "… as are those whose finds are spread out further than this");
}

bool is_left_of(const RepeatedFind& p, const RepeatedFind& q) {
  const Eigen::Vector2d& a = p.feature.point;
  const Eigen::Vector2d& b = q.feature.point;
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return p.feature.orientation_rad < q.feature.orientation_rad;
}

std::vector<RepeatedFind> gather_repeated_finds(std::span<const MapFind> finds, const ViewsInSight& views,
                                                const RepeatedFindsConfig& config) {
  // 1. Where finds gather.
  Finds gathered(finds, views.size(), config);
  const std::vector<Mode> modes = find_modes(gathered, config.min_views);
  // 2. What they say together, and how many views miss them.
  std::vector<RepeatedFind> repeated;
  std::vector<std::size_t> members;
  std::vector<double> ranges;
  for (const Mode& mode : modes) {
    members.clear();
    ranges.clear();
    gathered.for_each_alike(mode, config.same_place_m, [&](std::size_t i) {
      members.push_back(i);
      ranges.push_back(finds[i].range_m);
    });
    const double range_m = quantile(ranges, kUsualRange_share);
    const auto near = std::count_if(ranges.begin(), ranges.end(), [&](double r) { return r <= range_m; });
    RepeatedFind found = summary(gathered, members);
    const int seen = std::max(1, views.that_see(found.feature.point, range_m));
    found.evidence.found_views = mode.views;
    found.evidence.share = std::min(1.0, static_cast<double>(near) / seen);
    if (found.evidence.share >= config.min_share && found.evidence.scatter_m <= config.max_scatter_m)
      repeated.push_back(found);
  }
  std::sort(repeated.begin(), repeated.end(), is_left_of);
  return repeated;
}

}  // namespace beaconless
