// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/svg.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/report/png.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr double kFarthest_px = 1e6;

long tenths(double value_px) { return std::lround(10.0 * std::clamp(value_px, -kFarthest_px, kFarthest_px)); }

std::string from_tenths(long value) { return number(0.1 * static_cast<double>(value), 1); }

/// Two numbers with as little between them as the grammar of paths needs.
std::string pair(long x, long y) {
  std::string text = from_tenths(x);
  if (y >= 0) text += ' ';
  return text + from_tenths(y);
}

}  // namespace

void PathData::move_to(const Eigen::Vector2d& point) {
  lift();
  if (!point.allFinite()) return;
  x_ = tenths(point.x());
  y_ = tenths(point.y());
  text_ += 'M' + pair(x_, y_);
  down_ = single_ = true;
}

void PathData::line_to(const Eigen::Vector2d& point) {
  if (!point.allFinite()) return lift();
  if (!down_) return move_to(point);
  step_to(tenths(point.x()), tenths(point.y()));
}

void PathData::step_to(long x, long y) {
  if (x == x_ && y == y_) return;
  if (y == y_)
    text_ += 'h' + from_tenths(x - x_);
  else if (x == x_)
    text_ += 'v' + from_tenths(y - y_);
  else
    text_ += 'l' + pair(x - x_, y - y_);
  x_ = x;
  y_ = y;
  single_ = false;
}

void PathData::dot(const Eigen::Vector2d& point) {
  move_to(point);
  lift();
}

void PathData::lift() {
  if (single_) text_ += "h0";
  down_ = single_ = false;
}

void PathData::close() {
  if (down_ && !single_) text_ += 'z';
  lift();
}

void Svg::line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::string_view classes) {
  if (!a.allFinite() || !b.allFinite()) return;
  fmt::format_to(std::back_inserter(body_), "<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n",
                 escaped(classes), number(a.x()), number(a.y()), number(b.x()), number(b.y()));
}

void Svg::path(const PathData& data, std::string_view classes) {
  if (data.empty()) return;
  fmt::format_to(std::back_inserter(body_), "<path class=\"{}\" d=\"{}\"/>\n", escaped(classes), data.text());
}

void Svg::polyline(std::span<const Eigen::Vector2d> points, std::string_view classes) {
  PathData data;
  for (const Eigen::Vector2d& point : points) data.line_to(point);
  path(data, classes);
}

void Svg::circle(const Eigen::Vector2d& center, double radius, std::string_view classes) {
  if (!center.allFinite() || !std::isfinite(radius)) return;
  fmt::format_to(std::back_inserter(body_), "<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n",
                 escaped(classes), number(center.x()), number(center.y()), number(std::max(radius, 0.0)));
}

void Svg::ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& radii, double angle_rad,
                  std::string_view classes) {
  if (!center.allFinite() || !radii.allFinite() || !std::isfinite(angle_rad)) return;
  fmt::format_to(std::back_inserter(body_),
                 "<ellipse class=\"{}\" rx=\"{}\" ry=\"{}\" transform=\"translate({} {}) rotate({})\"/>\n",
                 escaped(classes), number(std::max(radii.x(), 0.0)), number(std::max(radii.y(), 0.0)),
                 number(center.x()), number(center.y()), number(degrees(angle_rad)));
}

void Svg::rect(const Eigen::Vector2d& low, const Eigen::Vector2d& high, std::string_view classes) {
  if (!low.allFinite() || !high.allFinite()) return;
  fmt::format_to(std::back_inserter(body_),
                 "<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", escaped(classes),
                 number(low.x()), number(low.y()), number(std::max(high.x() - low.x(), 0.0)),
                 number(std::max(high.y() - low.y(), 0.0)));
}

void Svg::text(const Eigen::Vector2d& at, std::string_view words, std::string_view classes, TextSide side) {
  if (!at.allFinite() || words.empty()) return;
  // dy in em, not dominant-baseline: it follows the font size and every viewer knows it.
  const std::string_view dy = side == TextSide::on       ? ""
                              : side == TextSide::middle ? " dy=\".35em\""
                                                         : " dy=\".8em\"";
  fmt::format_to(std::back_inserter(body_), "<text class=\"{}\" x=\"{}\" y=\"{}\"{}>{}</text>\n",
                 escaped(classes), number(at.x()), number(at.y()), dy, escaped(words));
}

void Svg::png(const std::string& file_bytes, const Eigen::Vector2i& pixels,
              const Eigen::Matrix<double, 2, 3>& picture_from_pixel, std::string_view classes) {
  if (file_bytes.empty() || !picture_from_pixel.allFinite()) return;
  const auto& m = picture_from_pixel;
  fmt::format_to(std::back_inserter(body_),
                 "<image class=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
                 "transform=\"matrix({} {} {} {} {} {})\" href=\"data:image/png;base64,{}\"/>\n",
                 escaped(classes), pixels.x(), pixels.y(), number(m(0, 0), 6), number(m(1, 0), 6),
                 number(m(0, 1), 6), number(m(1, 1), 6), number(m(0, 2), 3), number(m(1, 2), 3),
                 base64(file_bytes));
}

void Svg::open(std::string_view classes) {
  body_ += fmt::format("<g class=\"{}\">\n", escaped(classes));
  closers_ += 'g';
}

void Svg::open_window(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  // A nested <svg> cuts off without the ids that a <clipPath> needs, which would clash on a page of many
  // pictures.
  const std::string box = fmt::format("{} {}", number(low.x()), number(low.y()));
  const std::string size = fmt::format("{} {}", number(high.x() - low.x()), number(high.y() - low.y()));
  body_ +=
      fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"{} {}\">\n", number(low.x()),
                  number(low.y()), number(high.x() - low.x()), number(high.y() - low.y()), box, size);
  closers_ += 's';
}

void Svg::close() {
  if (closers_.empty()) return;
  body_ += closers_.back() == 'g' ? "</g>\n" : "</svg>\n";
  closers_.pop_back();
}

}  // namespace beaconless::report
