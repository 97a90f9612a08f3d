// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "beaconless/pose_estimate.hpp"
#include "beaconless/report/svg.hpp"

namespace beaconless::report {

/// The colours of the pictures, each told from the others with any colour vision, and each with a twin for
/// dark pages.
///
/// Source: Okabe and Ito, "Color universal design", 2008. Differs: darker where thin lines on white would be
/// faint.
enum class Colour { ink, grey, blue, orange, red, green, purple, sky };

std::string_view to_string(Colour colour);

/// The colour that a status has in every picture.
constexpr Colour colour_of(Status status) {
  switch (status) {
    case Status::ok:
      return Colour::blue;
    case Status::degraded:
      return Colour::orange;
    case Status::lost:
      return Colour::red;
    case Status::relocalizing:
      return Colour::purple;
    case Status::not_started:
    case Status::not_a_scan:
      break;
  }
  return Colour::grey;
}

/// What stands before a line of the legend.
enum class Mark { line, thin, dashed, halo, dots, band, bar, ring, square, outline, wall, unknown };

struct LegendEntry {
  std::string text;
  Mark mark = Mark::line;
  Colour colour = Colour::blue;
};

/// A drawing, and the legend that a page sets below it as text and a file draws into it.
struct Picture {
  double width_px = 0.0;
  double height_px = 0.0;
  Svg svg;
  std::string label;  ///< what it shows, for those who cannot see it
  std::vector<LegendEntry> legend;
  std::string note;  ///< what a reader must know and the picture cannot show; may be empty
};

/// The classes that every shape of this module is drawn with, in light, dark and print. Write it once a page.
std::string picture_css();

/// The drawing without its legend, for a page that has `picture_css()`.
std::string svg_inline(const Picture& picture);

/// The mark of a legend entry as a drawing of 28 x 14 units.
std::string svg_inline(const LegendEntry& entry);

/// A file of its own, with background, style and legend.
std::string svg_file(const Picture& picture);

/// A picture and what stands above it.
struct TitledPicture {
  std::string title;
  Picture picture;
};

/// Several pictures in one file, in rows as wide as the widest of them, each with its title and its legend.
std::string svg_sheet(std::span<const TitledPicture> pictures);

}  // namespace beaconless::report
