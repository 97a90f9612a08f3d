// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/picture.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/report/covariance_ellipse.hpp"
#include "beaconless/report/png.hpp"

#include "tests/report/well_formed.hpp"

namespace beaconless::report {
namespace {

using testing::HasSubstr;
using testing::Not;

const double kNan = std::nan("");

TEST(XmlFault, FindsFaults) {
  EXPECT_EQ(xml_fault("<a><b c=\">\"/>x</a>"), "");
  EXPECT_NE(xml_fault("<a><b></a></b>"), "");
  EXPECT_NE(xml_fault("<a"), "");
  EXPECT_NE(xml_fault("<a>"), "");
}

TEST(PathData, IsRelativeInTenthsAndDoesNotDrift) {
  PathData path;
  for (int i = 0; i <= 1000; ++i) path.line_to({0.04 * i, 10.0});
  // 0.04 rounds to nothing each time; relative steps must still add up to 40.
  const std::string text = path.text();
  double x = 0.0;
  for (std::size_t at = text.find('h'); at != std::string::npos; at = text.find('h', at + 1))
    x += std::stod(text.substr(at + 1));
  EXPECT_NEAR(x, 40.0, 1e-9);
}

TEST(PathData, LiftsThePenWhereAPointIsMissing) {
  PathData path;
  for (const double x : {0.0, 1.0, kNan, 3.0, 4.0, kNan, 9.0}) path.line_to({x, 0.0});
  EXPECT_EQ(path.text(), "M0 0h1M3 0h1M9 0h0");
}

TEST(PathData, OnePointIsADot) {
  PathData path;
  path.line_to({2.0, -3.5});
  EXPECT_EQ(path.text(), "M2-3.5h0");
}

TEST(Svg, EscapesTextAndClasses) {
  Svg svg;
  svg.text({1, 2}, "</text><script>", "\"><script>");
  EXPECT_THAT(svg.body(), Not(HasSubstr("<script>")));
  EXPECT_EQ(xml_fault(svg.body()), "");
}

TEST(Svg, LeavesOutWhatIsNotFinite) {
  Svg svg;
  svg.line({kNan, 0}, {1, 1}, "a");
  svg.circle({0, 0}, std::numeric_limits<double>::infinity(), "a");
  svg.ellipse({0, 0}, {1, 1}, kNan, "a");
  svg.rect({0, 0}, {kNan, 1}, "a");
  svg.text({kNan, 0}, "x", "a");
  svg.polyline(std::vector<Eigen::Vector2d>{{kNan, kNan}}, "a");
  EXPECT_EQ(svg.body(), "");
}

TEST(WorldView, HasYUpAtOneScale) {
  const WorldView view{{10.0, 20.0}, {14.0, 22.0}, {50.0, 5.0}, 100.0};
  EXPECT_EQ(view({10.0, 22.0}), Eigen::Vector2d(50.0, 5.0));
  EXPECT_EQ(view({14.0, 20.0}), Eigen::Vector2d(450.0, 205.0));
  EXPECT_EQ(view.bottom_right_px(), Eigen::Vector2d(450.0, 205.0));
}

TEST(Picture, IsAFileOfItsOwnWithItsLegend) {
  Picture picture{300.0, 100.0, {}, "a <label>", {}, ""};
  for (int i = 0; i < 12; ++i)
    picture.legend.push_back({"entry & " + std::to_string(i), static_cast<Mark>(i), Colour::red});
  const std::string file = svg_file(picture);
  EXPECT_EQ(xml_fault(file), "");
  EXPECT_THAT(file, HasSubstr("entry &amp; 11"));
  EXPECT_THAT(file, HasSubstr("xmlns"));
  EXPECT_THAT(file, HasSubstr("prefers-color-scheme"));
}

TEST(CovarianceEllipse, HasTheAxesOfTheGaussianItWasTurnedFrom) {
  Rng rng(5);
  for (int run = 0; run < 500; ++run) {
    const double major = rng.uniform(1.0, 2.0);
    const double minor = rng.uniform(0.0, 0.9);
    const double angle = rng.uniform(-1.5, 1.5);
    const Eigen::Matrix2d turn = Pose2{0, 0, angle}.rotation();
    const Eigen::Matrix2d covariance =
        turn * Eigen::Vector2d(major * major, minor * minor).asDiagonal() * turn.transpose();
    const Ellipse ellipse = covariance_ellipse(covariance, 3.0);
    EXPECT_NEAR(ellipse.major_m, 3.0 * major, 1e-9);
    EXPECT_NEAR(ellipse.minor_m, 3.0 * minor, 1e-6);  // a root near zero loses half the digits
    EXPECT_NEAR(std::sin(ellipse.angle_rad - angle), 0.0, 1e-9);
  }
  EXPECT_EQ(covariance_ellipse(Eigen::Matrix2d::Constant(kNan)).major_m, 0.0);
}

TEST(Png, ReadsBackAsTheSamePixels) {
  for (const std::size_t colours : {2U, 3U, 16U, 200U}) {
    IndexedImage image{37, 11, {}, {}};
    for (std::size_t i = 0; i < colours; ++i) {
      const auto value = static_cast<std::uint8_t>(i);
      image.palette.push_back(
          {value, static_cast<std::uint8_t>(255 - value), 7, i == 0 ? std::uint8_t{0} : std::uint8_t{255}});
    }
    for (std::size_t i = 0; i < 37 * 11; ++i)
      image.pixels.push_back(static_cast<std::uint8_t>((i * 7) % colours));
    const std::string file = encode_png(image);
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&header, file.data(), file.size()), 0);
    ASSERT_EQ(header.width, 37U);
    ASSERT_EQ(header.height, 11U);
    header.format = PNG_FORMAT_RGBA;
    std::vector<IndexedImage::Rgba> pixels(37 * 11);
    ASSERT_NE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr), 0);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const IndexedImage::Rgba& colour = image.palette[image.pixels[i]];
      EXPECT_EQ(pixels[i][3], colour[3]) << i;
      if (colour[3] != 0) {  // what is clear has no colour
        EXPECT_EQ(pixels[i], colour) << i;
      }
    }
  }
}

TEST(Png, RefusesSizesThatContradictEachOther) {
  EXPECT_EQ(encode_png({}), "");
  EXPECT_EQ(encode_png({2, 2, {{0, 0, 0, 0}}, {0, 0, 0}}), "");
  EXPECT_EQ(encode_png({1, 1, {{0, 0, 0, 0}}, {1}}), "");
}

TEST(Base64, KnowsTheVectorsOfItsStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xFE"), "//4=");
}

}  // namespace
}  // namespace beaconless::report
