// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace beaconless::report {

/// The shape of an SVG path, in tenths of a picture unit and relative steps, which keeps long paths small.
///
/// A point that is not finite lifts the pen, so that what is missing shows as a gap. A piece of one point is
/// a dot.
class PathData {
 public:
  void move_to(const Eigen::Vector2d& point);
  void line_to(const Eigen::Vector2d& point);
  void dot(const Eigen::Vector2d& point);
  void lift();
  void close();  ///< back to where the piece began

  bool empty() const { return text_.empty(); }
  std::string text() const { return single_ ? text_ + "h0" : text_; }

 private:
  void step_to(long x, long y);

  std::string text_;
  long x_ = 0;
  long y_ = 0;
  bool down_ = false;    ///< a line can go on from here
  bool single_ = false;  ///< the piece is one point so far
};

/// How a line of text stands to its point.
enum class TextSide { on, middle, below };

/// Writes the elements of an SVG picture: x to the right, y down, in picture units. Looks come from CSS
/// classes.
///
/// Elements with a number that is not finite are left out. Text is escaped here, so callers pass it as it is.
class Svg {
 public:
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::string_view classes);
  void path(const PathData& data, std::string_view classes);
  void polyline(std::span<const Eigen::Vector2d> points, std::string_view classes);
  void circle(const Eigen::Vector2d& center, double radius, std::string_view classes);
  /// `angle_rad` turns the first radius from x towards y down.
  void ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& radii, double angle_rad,
               std::string_view classes);
  void rect(const Eigen::Vector2d& low, const Eigen::Vector2d& high, std::string_view classes);
  /// Classes "mid" and "end" anchor the text there; default is its start.
  void text(const Eigen::Vector2d& at, std::string_view words, std::string_view classes,
            TextSide side = TextSide::on);
  /// A PNG file of `pixels` size, carried to the picture by the affine `picture_from_pixel`.
  void png(const std::string& file_bytes, const Eigen::Vector2i& pixels,
           const Eigen::Matrix<double, 2, 3>& picture_from_pixel, std::string_view classes);

  /// What is drawn until `close` has its classes; `open_window` also cuts it off outside a box.
  void open(std::string_view classes);
  void open_window(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void close();

  const std::string& body() const { return body_; }

 private:
  std::string body_;
  std::string closers_;  ///< one letter an open element: g, s
};

/// Where points of a plane with y up come to lie in a picture with y down, at one scale for both axes.
struct WorldView {
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();  ///< lower left corner that is seen, map frame
  Eigen::Vector2d high_m = Eigen::Vector2d::Ones();
  Eigen::Vector2d top_left_px = Eigen::Vector2d::Zero();
  double px_per_m = 1.0;

  Eigen::Vector2d operator()(const Eigen::Vector2d& point_m) const {
    return top_left_px + px_per_m * Eigen::Vector2d(point_m.x() - low_m.x(), high_m.y() - point_m.y());
  }
  Eigen::Vector2d bottom_right_px() const { return (*this)({high_m.x(), low_m.y()}); }
};

}  // namespace beaconless::report
