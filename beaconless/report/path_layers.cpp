// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "beaconless/report/covariance_ellipse.hpp"
#include "beaconless/report/map_layers.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr double kSamePoint_px = 0.5;
constexpr std::size_t kMostPathPoints = 40'000;
constexpr std::size_t kMostEllipses = 40;
constexpr double kSmallestEllipse_px = 4.0;
constexpr double kLargestEllipse_px = 80.0;
const Eigen::Vector2d kNowhere = Eigen::Vector2d::Constant(-1e9);

/// The statuses that have a place in the map, worst last so that it lies on top.
constexpr std::array kShown{Status::ok, Status::degraded, Status::relocalizing, Status::lost};

bool is_shown(const PoseEstimate& estimate) {
  return estimate.map_from_base.is_finite() &&
         std::find(kShown.begin(), kShown.end(), estimate.status) != kShown.end();
}

std::size_t severity(Status status) {
  return static_cast<std::size_t>(std::find(kShown.begin(), kShown.end(), status) - kShown.begin());
}

std::string classes(std::string_view kind, Colour colour) {
  return std::string(kind) + " " + std::string(to_string(colour));
}

void draw_heading(Svg& svg, const Eigen::Vector2d& at, double theta_rad, std::string_view colour) {
  const Eigen::Vector2d ahead(std::cos(theta_rad), -std::sin(theta_rad));
  svg.line(at + 6.0 * ahead, at + 20.0 * ahead, "line thick " + std::string(colour));
}

}  // namespace

void draw_reference(Picture& picture, const WorldView& view, const Trajectory& reference) {
  const std::size_t stride = 1 + reference.size() / kMostPathPoints;
  PathData line;
  Eigen::Vector2d last = kNowhere;
  for (std::size_t i = 0; i < reference.size(); i += stride) {
    const Eigen::Vector2d at = view(reference[i].pose.translation());
    if ((at - last).norm() < kSamePoint_px && i + stride < reference.size()) continue;
    line.line_to(at);
    last = at;
  }
  if (line.empty()) return;
  picture.svg.path(line, classes("halo", Colour::grey));
  picture.legend.push_back({"reference", Mark::halo, Colour::grey});
}

void draw_estimates(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates) {
  std::array<PathData, kShown.size()> lines;
  const std::size_t stride = 1 + estimates.size() / kMostPathPoints;
  Eigen::Vector2d last = kNowhere;
  std::size_t pen = kShown.size();  // whose line goes on from `last`
  std::size_t worst = 0;            // status met since; a skipped pose still colours the next piece
  std::size_t end = estimates.size();
  while (end > 0 && !is_shown(estimates[end - 1])) --end;
  for (std::size_t i = 0; i < end; ++i) {
    if (!is_shown(estimates[i])) continue;
    worst = std::max(worst, severity(estimates[i].status));
    const Eigen::Vector2d at = view(estimates[i].map_from_base.translation());
    const bool first = last == kNowhere;
    const bool skip = (at - last).norm() < kSamePoint_px || i % stride != 0;
    const bool final = i + 1 == end;
    if (skip && !first && !final) continue;
    if (pen != worst) lines[worst].move_to(first ? at : last);
    lines[worst].line_to(at);
    pen = worst;
    worst = 0;
    last = at;
  }
  for (std::size_t i = 0; i < kShown.size(); ++i) {
    if (lines[i].empty()) continue;
    picture.svg.path(lines[i], classes("line thick", colour_of(kShown[i])));
    picture.legend.push_back(
        {"estimate, " + std::string(to_string(kShown[i])), Mark::line, colour_of(kShown[i])});
  }
}

void draw_ellipses(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates,
                   const MapViewConfig& config) {
  const std::size_t stride = 1 + estimates.size() / kMostEllipses;
  bool any = false;
  for (std::size_t i = 0; i < estimates.size(); i += stride) {
    if (!is_shown(estimates[i])) continue;
    const Ellipse ellipse =
        covariance_ellipse(estimates[i].covariance.topLeftCorner<2, 2>(), config.ellipse_sigma_count);
    const double major = view.px_per_m * ellipse.major_m;
    if (major < kSmallestEllipse_px || major > kLargestEllipse_px) continue;
    picture.svg.ellipse(view(estimates[i].map_from_base.translation()),
                        {major, view.px_per_m * ellipse.minor_m}, -ellipse.angle_rad,
                        classes("outline", colour_of(estimates[i].status)));
    any = true;
  }
  if (any)
    picture.legend.push_back(
        {number(config.ellipse_sigma_count) + "-sigma ellipse of some poses", Mark::outline, Colour::blue});
}

void draw_ends(Picture& picture, const WorldView& view, std::span<const PoseEstimate> estimates) {
  const auto first = std::find_if(estimates.begin(), estimates.end(), is_shown);
  if (first == estimates.end()) return;
  const auto last = std::find_if(estimates.rbegin(), estimates.rend(), is_shown);
  const Eigen::Vector2d start = view(first->map_from_base.translation());
  const Eigen::Vector2d end = view(last->map_from_base.translation());
  const bool together = (start - end).norm() < 40.0;
  // Names go to the side where there is more room, and above or below so that the heading does not cross
  // them.
  const bool below = std::sin(first->map_from_base.theta_rad) > 0.0;
  const auto label = [&](const Eigen::Vector2d& at, const char* words) {
    const bool left = at.x() > 0.5 * (view.top_left_px.x() + view.bottom_right_px().x());
    picture.svg.text(at + Eigen::Vector2d(left ? -12.0 : 12.0, below ? 14.0 : -14.0), words,
                     left ? "tag end" : "tag", TextSide::middle);
  };
  picture.svg.rect(end - Eigen::Vector2d::Constant(6.0), end + Eigen::Vector2d::Constant(6.0),
                   "marker purple");
  picture.svg.circle(start, 6.0, "marker purple");
  draw_heading(picture.svg, start, first->map_from_base.theta_rad, "purple");
  if (!together) label(end, "end");
  label(start, together ? "start, end" : "start");
  picture.legend.push_back({"start and heading", Mark::ring, Colour::purple});
  picture.legend.push_back({"end", Mark::square, Colour::purple});
}

}  // namespace beaconless::report
