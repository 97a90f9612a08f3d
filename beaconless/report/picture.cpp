// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/picture.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr double kMarkWidth = 28.0;
constexpr double kMarkHeight = 14.0;
constexpr double kLegendRow = 24.0;
constexpr double kLetterWidth = 7.2;  // of the 13 px font, on average and a little more

struct Shades {
  Colour colour;
  std::string_view name;
  std::string_view light;
  std::string_view dark;
};

constexpr std::array<Shades, 8> kPalette{{
    {Colour::ink, "ink", "#1c2330", "#e4e7ec"},
    {Colour::grey, "grey", "#7b8494", "#8d96a5"},
    {Colour::blue, "blue", "#0069b4", "#5cb3f2"},
    {Colour::orange, "orange", "#e08a00", "#f5b13d"},
    {Colour::red, "red", "#b3122b", "#ff6f73"},
    {Colour::green, "green", "#00875f", "#3ecb9c"},
    {Colour::purple, "purple", "#9a4a94", "#dba3d6"},
    {Colour::sky, "sky", "#56b4e9", "#8ccff5"},
}};

constexpr std::string_view kShapes = R"(
.pic{display:block;font:13px system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
.pic text{stroke:none}
.pic .mid{text-anchor:middle}
.pic .end{text-anchor:end}
.pic .title{font-weight:600}
.pic .line,.pic .grid,.pic .axis,.pic .outline{fill:none;vector-effect:non-scaling-stroke}
.pic .line{stroke-width:1.6;stroke-linejoin:round;stroke-linecap:round}
.pic .thick{stroke-width:2.6}
.pic .halo{fill:none;stroke-width:8;stroke-opacity:.38;stroke-linejoin:round;stroke-linecap:round}
.pic .thin{stroke-width:1.1;stroke-opacity:.7}
.pic .dashed{stroke-dasharray:6 4;stroke-linecap:butt}
.pic .dots{fill:none;stroke-width:2.2;stroke-linecap:round}
.pic .band{fill-opacity:.22}
.pic .bar{fill-opacity:.8}
.pic .outline{stroke-width:1;fill-opacity:.12}
.pic .grid{stroke-width:1;stroke-opacity:.13}
.pic .axis{stroke-width:1;stroke-opacity:.55}
.pic .marker{stroke-width:2.2}
.pic .tag{font-weight:600;paint-order:stroke;stroke-width:4;stroke-linejoin:round}
.pic .pixels{image-rendering:pixelated}
)";

std::string colours(bool dark) {
  std::string css;
  for (const Shades& shades : kPalette)
    fmt::format_to(
        std::back_inserter(css),
        ".pic .{0}{{stroke:{1};fill:{1}}}.pic .line.{0},.pic .halo.{0},.pic .dots.{0}{{fill:none}}\n",
        shades.name, dark ? shades.dark : shades.light);
  const std::string_view ink = dark ? kPalette[0].dark : kPalette[0].light;
  const std::string_view soft = dark ? "#a3abb8" : "#5a6372";
  const std::string_view paper = dark ? "#14181f" : "#ffffff";
  fmt::format_to(
      std::back_inserter(css),
      ".pic text{{fill:{0}}}.pic .soft{{fill:{1}}}.pic .grid,.pic .axis{{stroke:{0}}}\n"
      ".pic .tag{{stroke:{2}}}.pic .marker{{fill:{2}}}.pic .paper{{fill:{2};stroke:none}}\n"
      ".pic .grid,.pic .axis{{fill:none}}.pic .band,.pic .bar{{stroke:none}}.pic .raster{{filter:{3}}}\n",
      ink, soft, paper, dark ? "invert(1)" : "none");
  return css;
}

void draw_mark(Svg& svg, const LegendEntry& entry, const Eigen::Vector2d& at) {
  const auto point = [&](double x, double y) { return Eigen::Vector2d(at + Eigen::Vector2d(x, y)); };
  const std::string colour(to_string(entry.colour));
  const double middle = 0.5 * kMarkHeight;
  switch (entry.mark) {
    case Mark::line:
      return svg.line(point(3, middle), point(25, middle), "line thick " + colour);
    case Mark::dashed:
      return svg.line(point(3, middle), point(25, middle), "line dashed " + colour);
    case Mark::thin:
    case Mark::wall:
      return svg.line(point(3, middle), point(25, middle), "line " + colour);
    case Mark::halo:
      return svg.line(point(5, middle), point(23, middle), "halo " + colour);
    case Mark::dots: {
      PathData dots;
      for (const double x : {6.0, 14.0, 22.0}) dots.dot(point(x, middle));
      return svg.path(dots, "dots " + colour);
    }
    case Mark::unknown:
      return svg.rect(point(5, 2), point(23, 12), "band " + colour);
    case Mark::band:
      return svg.rect(point(5, 1), point(23, 13), "band " + colour);
    case Mark::bar:
      return svg.rect(point(5, 2), point(23, 12), "bar " + colour);
    case Mark::outline:
      return svg.ellipse(point(14, middle), {10.0, 5.0}, 0.0, "outline " + colour);
    case Mark::ring:
      return svg.circle(point(14, middle), 5.0, "marker " + colour);
    case Mark::square:
      return svg.rect(point(9.5, 2.5), point(18.5, 11.5), "marker " + colour);
  }
}

std::string opening(const Picture& picture, double height_px, std::string_view attributes) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"pic\" viewBox=\"0 0 {} {}\"{} role=\"img\" "
      "aria-label=\"{}\">\n",
      number(picture.width_px), number(height_px), attributes, escaped(picture.label));
}

/// A picture on paper with its legend below, and how high both are.
struct Drawn {
  std::string body;
  double height_px = 0.0;
};

Drawn with_legend(const Picture& picture) {
  Svg legend;
  Eigen::Vector2d at(8.0, picture.height_px + 4.0);
  for (const LegendEntry& entry : picture.legend) {
    // Bytes count letters of other alphabets twice: rather too wide than on top of each other.
    const double width = kMarkWidth + 6.0 + kLetterWidth * static_cast<double>(entry.text.size()) + 16.0;
    if (at.x() > 8.0 && at.x() + width > picture.width_px) at = {8.0, at.y() + kLegendRow};
    draw_mark(legend, entry, at);
    legend.text(at + Eigen::Vector2d(kMarkWidth + 6.0, 0.5 * kMarkHeight), entry.text, "", TextSide::middle);
    at.x() += width;
  }
  const double height = picture.legend.empty() ? picture.height_px : at.y() + kLegendRow;
  Svg paper;
  paper.rect(Eigen::Vector2d::Zero(), {picture.width_px, height}, "paper");
  return {paper.body() + picture.svg.body() + legend.body(), height};
}

}  // namespace

std::string_view to_string(Colour colour) {
  for (const Shades& shades : kPalette)
    if (shades.colour == colour) return shades.name;
  return "ink";
}

std::string picture_css() {
  return std::string(kShapes) + colours(false) + "@media screen and (prefers-color-scheme:dark){\n" +
         colours(true) + "}\n";
}

std::string svg_inline(const Picture& picture) {
  return opening(picture, picture.height_px, "") + picture.svg.body() + "</svg>\n";
}

std::string svg_inline(const LegendEntry& entry) {
  Svg svg;
  draw_mark(svg, entry, Eigen::Vector2d::Zero());
  return fmt::format(
      "<svg class=\"pic mark\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "aria-hidden=\"true\">{2}</svg>",
      number(kMarkWidth), number(kMarkHeight), svg.body());
}

std::string svg_file(const Picture& picture) {
  const Drawn drawn = with_legend(picture);
  const std::string size =
      fmt::format(" width=\"{}\" height=\"{}\"", number(picture.width_px), number(drawn.height_px));
  return opening(picture, drawn.height_px, size) + "<style>" + picture_css() + "</style>\n" + drawn.body +
         "</svg>\n";
}

std::string svg_sheet(std::span<const TitledPicture> pictures) {
  constexpr double kMargin_px = 24.0;
  constexpr double kTitle_px = 34.0;
  double width = 0.0;
  for (const TitledPicture& titled : pictures)
    width = std::max(width, titled.picture.width_px + 2.0 * kMargin_px);
  std::string body;
  Eigen::Vector2d at(kMargin_px, kMargin_px);
  double row_px = 0.0;
  for (const TitledPicture& titled : pictures) {
    const Drawn drawn = with_legend(titled.picture);
    const double picture_px = titled.picture.width_px;
    if (at.x() + picture_px + kMargin_px > width + 1.0) {
      at = {kMargin_px, at.y() + row_px + kMargin_px};
      row_px = 0.0;
    }
    Svg title;
    title.text(at + Eigen::Vector2d(0.0, 0.5 * kTitle_px), titled.title, "title", TextSide::middle);
    body +=
        title.body() + fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n", number(at.x()),
                                   number(at.y() + kTitle_px), number(picture_px), number(drawn.height_px));
    body += drawn.body + "</svg>\n";
    row_px = std::max(row_px, kTitle_px + drawn.height_px);
    at.x() += picture_px + kMargin_px;
  }
  const double height = at.y() + row_px + kMargin_px;
  const Picture sheet{width, height, {}, "several pictures", {}, {}};
  Svg paper;
  paper.rect(Eigen::Vector2d::Zero(), {width, height}, "paper");
  const std::string size = fmt::format(" width=\"{}\" height=\"{}\"", number(width), number(height));
  return opening(sheet, height, size) + "<style>" + picture_css() + "</style>\n" + paper.body() + body +
         "</svg>\n";
}

}  // namespace beaconless::report
