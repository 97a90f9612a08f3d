// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/place_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "beaconless/localize/same_place.hpp"
#include "beaconless/match/sidesteps.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kBeams = 400;  // that weigh a place
constexpr std::size_t kMostViews = 8;
constexpr double kStray_m = 0.3;  // a fit that strays further from its guess is another place
constexpr double kStray_rad = radians(10.0);
constexpr double kSoon_s = 0.2;     // after places have vanished, before is looked again
constexpr double kNear_m = 0.1;     // how far ICP may be from where the walls are
constexpr double kHeld_m = 0.3;     // a place less certain than this is not held
constexpr double kBehind = 1.0;     // a place so far behind the best is given up …
constexpr double kFarBehind = 3.0;  // … and so many margins
constexpr double kAlone = 0.5;      // so far ahead of all others, and as many margins, it is alone
constexpr double kMostThrough = 0.25;
constexpr double kPromising = 0.05;  // in cost: starts this near to the best are worth a second look …
constexpr double kBroken = 0.15;     // … where the fit explains so much less than the search promised
constexpr double kFine_m = 0.05;     // the margin is for maps that are off by this
constexpr std::size_t kViewsOfCoarse = 6;  // that it takes on others
constexpr double kCoarse = 1.5;            // … and grows with so many powers of what others are off by more
constexpr double kBeamsThatCount = 20.0;   // of a scan, the others say what these do

/// Whether a pose is off another by more than a fit may correct.
bool is_astray(const Pose2& a, const Pose2& b) {
  return distance_m(a, b) > kStray_m || heading_difference_rad(a, b) > kStray_rad;
}

}  // namespace

void describe(Fields& fields, PlacesConfig& config) {
  fields.section("search", config.search);
  fields("sigma_m", config.sigma_m, {0.005, 1.0},
         "by how much surfaces of the map may be off; no less than a grid's cells");
  fields("margin", config.margin, {0.0, 100.0},
         "mean log-likelihood of a beam, added up over views, that a place must be ahead of all others");
  fields("doubt", config.doubt, {0.0, 100.0},
         "the margin grows by this times the share of the scan that is not on the map");
  fields("least_explained", config.least_explained, {0.0, 1.0},
         "share of the scan that must lie on the map at a place");
  fields("least_likelihood", config.least_likelihood, {-10.0, 0.0},
         "mean log-likelihood of a beam that a place must reach");
  fields("view_m", config.view_m, {0.05, 100.0}, "a new view begins when the laser has moved so far …");
  fields("view_deg", config.view_deg, {1.0, 180.0}, "… or turned so far");
  fields("every_s", config.every_s, {0.0, 1000.0}, "how often is looked again where nothing fits");
}

PlaceFinder::PlaceFinder(const PlacesConfig& config, std::shared_ptr<const SurfaceMap> map,
                         const IcpConfig& icp, const WallsConfig& walls)
    : config_(config),
      map_(std::move(map)),
      icp_(icp),
      walls_(walls),
      nearness_(*map_, config.search.cell_m, config.search.truncate_m),
      map_box_(bounds_of(*map_)),
      box_(map_box_) {}

void PlaceFinder::begin(const FloorPlan::Bounds& box, Wanted wanted) {
  box_ = box;
  wanted_ = std::move(wanted);
  places_.clear();
  views_.clear();
  looked_.reset();
  is_hopeless_ = true;
  begin_from_first_ = Pose2{};
  gone_m_ = 0.0;
  since_view_ = Pose2{};
  moved_.reset();
}

void PlaceFinder::begin() { begin(map_box_); }

void PlaceFinder::begin_around(const Eigen::Vector2d& middle, double reach_m) {
  const Eigen::Vector2d nearest = middle.cwiseMax(map_box_.low).cwiseMin(map_box_.high);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m);
  begin({(nearest - reach).cwiseMax(map_box_.low), (nearest + reach).cwiseMin(map_box_.high)});
}

void PlaceFinder::begin_again() { begin(FloorPlan::Bounds(box_), Wanted(wanted_)); }

PlaceFinder::Verdict PlaceFinder::see(Stamp stamp, std::span<const Eigen::Vector2d> points,
                                      const std::optional<Pose2>& moved) {
  points_ = points;
  // 1. The places so far, from where this scan was taken.
  const Pose2 way = moved.value_or(moved_.value_or(Pose2{}));
  if (places_.empty())
    moved_.reset();
  else
    follow(way);
  // 2. All that fit, with every view; where nothing does, soon, and then now and then.
  const bool is_hopeless = places_.empty() || verdict() == Verdict::nothing;
  const double pause_s = is_hopeless_ ? config_.every_s : std::min(kSoon_s, config_.every_s);
  const bool is_due = !looked_ || std::abs(seconds_between(*looked_, stamp)) >= pause_s;
  if (is_hopeless && is_due) begin_anew();
  if (views_.empty() ? is_due : is_new_view()) {
    look();
    looked_ = stamp;
  }
  // 3. What that says.
  proposed_.reset();
  sort_out();
  const Verdict said = verdict();
  is_hopeless_ = said == Verdict::nothing;
  return said;
}

/// Forgets what was seen, but not how far off the beginning is.
void PlaceFinder::begin_anew() {
  if (views_.empty()) return;
  views_.back().to_next = since_view_;
  for (const View& view : views_) begin_from_first_ = begin_from_first_ * view.to_next;
  gone_m_ += since_view_.translation().norm();
  since_view_ = Pose2{};
  views_.clear();
}

std::optional<Pose2> PlaceFinder::moved() const {
  return !places_.empty() && places_.front().rank > 0 ? moved_ : std::nullopt;
}

FloorPlan::Bounds PlaceFinder::reachable() const {
  const Eigen::Vector2d gone = Eigen::Vector2d::Constant(gone_m_);
  return {(box_.low - gone).cwiseMax(map_box_.low), (box_.high + gone).cwiseMin(map_box_.high)};
}

bool PlaceFinder::is_new_view() const {
  return since_view_.translation().norm() > config_.view_m ||
         std::abs(since_view_.theta_rad) > radians(config_.view_deg);
}

void PlaceFinder::follow(const Pose2& moved) {
  const Pose2 before = places_.front().map_from_laser;
  for (Place& place : places_) {
    const double seen = place.log_likelihoods.back();
    const double scans = place.scans_in_view++;
    const Pose2 guess = place.map_from_laser * moved;
    Place fitted;
    const bool is_held = fit(points_, guess, fitted) && !is_astray(fitted.map_from_laser, guess);
    place.map_from_laser = is_held ? fitted.map_from_laser : guess;
    place.covariance = is_held ? fitted.covariance : Eigen::Matrix3d::Identity();
    place.rank = is_held ? fitted.rank : 0;
    place.now = weigh_scan(points_, *map_, place.map_from_laser, config_.sigma_m, kBeams);
    place.log_likelihoods.back() = (scans * seen + place.now.log_likelihood) / (scans + 1.0);
  }
  moved_ = before.inverse() * places_.front().map_from_laser;
  since_view_ = since_view_ * *moved_;
}

void PlaceFinder::look() {
  // 1. This scan is a view of its own.
  if (!views_.empty()) {
    views_.back().to_next = since_view_;
    gone_m_ += since_view_.translation().norm();
  }
  if (views_.empty()) places_.clear();
  if (views_.size() == kMostViews) {
    begin_from_first_ = begin_from_first_ * views_.front().to_next;
    views_.erase(views_.begin());
    for (Place& place : places_) place.log_likelihoods.erase(place.log_likelihoods.begin());
  }
  views_.push_back({{points_.begin(), points_.end()}, Pose2{}});
  since_view_ = Pose2{};
  for (Place& place : places_) {
    place.log_likelihoods.push_back(place.now.log_likelihood);
    place.scans_in_view = 1;
  }
  // 2. Where it fits, and how all that was seen before fits there.
  search_everywhere(points_, nearness_, reachable(), config_.search, search_scratch_, starts_);
  for (const StartPose& start : starts_) add(start, start.cost < starts_.front().cost + kPromising);
  if (proposed_) add({*proposed_}, false);
}

bool PlaceFinder::add(const StartPose& start, bool is_promising) {
  Place place;
  if (!fit(points_, start.map_from_laser, place)) return false;
  const bool is_known = std::any_of(places_.begin(), places_.end(), [&](const Place& known) {
    return is_same_place(known.map_from_laser, place.map_from_laser);
  });
  if (is_known) return false;
  place.now = weigh_scan(points_, *map_, place.map_from_laser, config_.sigma_m, kBeams);
  const double promised = 1.0 - start.cost;
  if (is_promising && place.now.on_map < promised - kBroken) step_aside(place);
  place.log_likelihoods.assign(views_.size(), place.now.log_likelihood);
  place.scans_in_view = 1;
  const Pose2 first = weigh_past(place);
  if (wanted_ && !wanted_(first * begin_from_first_.inverse())) return false;
  places_.push_back(std::move(place));
  return true;
}

/// Out of a fit to the far faces of walls, if it is one.
void PlaceFinder::step_aside(Place& place) const {
  for (const Pose2& beside : sidesteps(place.map_from_laser)) {
    Place other;
    if (!fit(points_, beside, other) || is_astray(other.map_from_laser, beside)) continue;
    other.now = weigh_scan(points_, *map_, other.map_from_laser, config_.sigma_m, kBeams);
    if (other.now.log_likelihood > place.now.log_likelihood) place = other;
  }
}

/// Weighs the views before; where the first of them was seen from, if it is this place.
Pose2 PlaceFinder::weigh_past(Place& place) const {
  Pose2 then = place.map_from_laser;
  for (std::size_t view = views_.size() - 1; view-- > 0;) {
    const Pose2 guess = then * views_[view].to_next.inverse();
    Place past;
    then = fit(views_[view].points, guess, past) && !is_astray(past.map_from_laser, guess)
               ? past.map_from_laser
               : guess;
    place.log_likelihoods[view] =
        weigh_scan(views_[view].points, *map_, then, config_.sigma_m, kBeams).log_likelihood;
  }
  return then;
}

bool PlaceFinder::fit(std::span<const Eigen::Vector2d> points, const Pose2& guess, Place& place) const {
  MatchResult match = match_icp(points, *map_, guess, icp_, icp_scratch_);
  if (!match.usable()) return false;
  if (const auto* walls = std::get_if<WallIndex>(map_.get())) {
    const MatchResult finer =
        match_walls(points, *walls, match.map_from_laser, kNear_m, walls_, walls_scratch_);
    if (finer.usable()) match = finer;
  }
  place.map_from_laser = match.map_from_laser;
  place.covariance = match.covariance;
  place.rank = match.rank;
  return true;
}

void PlaceFinder::sort_out() {
  for (Place& place : places_) {
    place.total = 0.0;
    for (const double view : place.log_likelihoods) place.total += view;
  }
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.total > b.total; });
  // Places that have come together are one; what is far behind is none.
  const double behind = places_.empty() ? 0.0 : std::max(kBehind, kFarBehind * needed_margin());
  std::vector<Place> left;
  for (Place& place : places_) {
    const bool is_behind = !left.empty() && place.total < left.front().total - behind;
    const bool is_known = std::any_of(left.begin(), left.end(), [&](const Place& better) {
      return is_same_place(better.map_from_laser, place.map_from_laser);
    });
    if (!is_behind && !is_known) left.push_back(std::move(place));
  }
  places_ = std::move(left);
}

double PlaceFinder::needed_margin() const {
  // What a coarse map gets wrong it gets wrong in every view.
  const double views = config_.sigma_m <= kFine_m ? 1.0 : static_cast<double>(views_.size());
  const double coarse = views * std::pow(std::max(1.0, config_.sigma_m / kFine_m), kCoarse);
  return coarse * (config_.margin + config_.doubt * (1.0 - places_.front().now.on_map));
}

PlaceFinder::Verdict PlaceFinder::verdict() const {
  if (places_.empty()) return Verdict::nothing;
  const Place& best = places_.front();
  const double mean = best.total / static_cast<double>(best.log_likelihoods.size());
  if (best.now.on_map < config_.least_explained || best.now.through > kMostThrough ||
      mean < config_.least_likelihood)
    return Verdict::nothing;
  const bool is_held = best.rank == 3 && best.covariance.topLeftCorner<2, 2>().trace() < kHeld_m * kHeld_m;
  const bool is_ahead = places_.size() == 1 || places_[1].total < best.total - needed_margin();
  // On a coarse map one look never suffices: some place fits it by chance.
  const bool is_seen_enough = config_.sigma_m <= kFine_m || views_.size() >= kViewsOfCoarse;
  return is_held && is_ahead && is_seen_enough ? Verdict::one : Verdict::several;
}

std::span<const PlaceFinder::Place> PlaceFinder::likely() const {
  const auto end = std::find_if(places_.begin(), places_.end(), [&](const Place& place) {
    return place.total < places_.front().total - needed_margin();
  });
  return {places_.begin(), end};
}

bool PlaceFinder::is_alone() const {
  if (places_.size() < 2) return !places_.empty();
  return places_[1].total < places_[0].total - std::max(kAlone, kFarBehind * needed_margin());
}

double PlaceFinder::weight(const Place& place) const {
  double sum = 0.0;
  for (const Place& other : likely()) sum += std::exp(kBeamsThatCount * (other.total - place.total));
  return 1.0 / sum;
}

}  // namespace beaconless
