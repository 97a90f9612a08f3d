// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/gray_image.hpp"

#include "tests/io/picture_bytes.hpp"
#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MapImage, ReadsPlainPgmWithCommentsAndBlanksAnywhere) {
  const TempFolder folder;
  const auto image =
      read_image(folder.write("a.pgm", "P2 # a comment\n#another\r\n3\t# width\n 2\n255\n0 1 2\n3 4#x\n 5"));
  ASSERT_TRUE(image) << image.error();
  EXPECT_EQ(image->width_px, 3);
  EXPECT_EQ(image->height_px, 2);
  EXPECT_THAT(image->shades, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(MapImage, ReadsBinaryPgmWhosePixelsLookLikeBlanksAndComments) {
  const TempFolder folder;
  const auto image = read_image(folder.write("a.pgm", "P5\n# CREATOR: GIMP\n2 2\n255\n" + "#\n \0"s));
  ASSERT_TRUE(image) << image.error();
  EXPECT_THAT(image->shades, ElementsAre('#', '\n', ' ', 0));
}

TEST(MapImage, ScalesShadesToTheirMaxval) {
  const TempFolder folder;
  EXPECT_THAT(read_image(folder.write("1", p5(3, 1, "\0\1\2"s, 2)))->shades, ElementsAre(0, 128, 255));
  EXPECT_THAT(read_image(folder.write("2", p5(2, 1, "\xFF\xFF\x80\x80"s, 65535)))->shades,
              ElementsAre(255, 128));
  EXPECT_THAT(read_image(folder.write("3", "P2 3 1 15 0 15 7"))->shades, ElementsAre(0, 255, 119));
  EXPECT_THAT(read_image(folder.write("4", p5(2, 1, "\x03\x07"s, 3)))->shades, ElementsAre(255, 255));
}

TEST(MapImage, WhatIsWrittenReadsBack) {
  const TempFolder folder;
  GrayImage image{16, 16, {}, {}};
  for (int i = 0; i < 256; ++i) image.shades.push_back(static_cast<std::uint8_t>(i));
  ASSERT_TRUE(write_pgm(folder.path("a.pgm"), image));
  EXPECT_EQ(read_image(folder.path("a.pgm")).value(), image);
}

TEST(MapImage, ReadsPngOfEachKind) {
  const TempFolder folder;
  const auto read = [&](const std::string& bytes) {
    return read_image(folder.write("a.png", bytes)).value();
  };
  const GrayImage gray = read(png({2, 2, 8, 0}, "\0\x01\x02\0\x03\x04"s));
  EXPECT_THAT(gray.shades, ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(gray.opacity.empty());
  EXPECT_THAT(read(png({2, 1, 16, 0}, "\0\xFF\xFF\x80\x80"s)).shades, ElementsAre(255, 128));
  EXPECT_THAT(read(png({8, 1, 1, 0}, "\0\xA0"s)).shades, ElementsAre(255, 0, 255, 0, 0, 0, 0, 0));
  EXPECT_THAT(read(png({1, 1, 8, 2}, "\0\x0A\x14\x1F"s)).shades, ElementsAre(20));  // 61 / 3
  const GrayImage gray_alpha = read(png({2, 1, 8, 4}, "\0\x07\xFF\x09\x80"s));
  EXPECT_THAT(gray_alpha.shades, ElementsAre(7, 9));
  EXPECT_THAT(gray_alpha.opacity, ElementsAre(255, 128));
  const GrayImage rgba = read(png({1, 1, 8, 6}, "\0\x0A\x14\x1E\x05"s));
  EXPECT_THAT(rgba.shades, ElementsAre(20));
  EXPECT_THAT(rgba.opacity, ElementsAre(5));
  const std::string palette = png_chunk("PLTE", "\x03\x03\x03\x09\x09\x09"s);
  EXPECT_THAT(read(png({2, 1, 8, 3}, "\0\x01\x00"s, palette)).shades, ElementsAre(9, 3));
  const GrayImage keyed = read(png({2, 1, 8, 0}, "\0\x05\x06"s, png_chunk("tRNS", "\0\x05"s)));
  EXPECT_THAT(keyed.shades, ElementsAre(5, 6));
  EXPECT_THAT(keyed.opacity, ElementsAre(0, 255));
}

TEST(MapImage, ReadsInterlacedPng) {
  // Adam7 of a 2 x 2 picture: the pixel (0, 0), then (1, 0), then the row y = 1.
  const TempFolder folder;
  const auto image = read_image(folder.write("a.png", png({2, 2, 8, 0, 1}, "\0\x01\0\x02\0\x03\x04"s)));
  ASSERT_TRUE(image) << image.error();
  EXPECT_THAT(image->shades, ElementsAre(1, 2, 3, 4));
}

TEST(MapImage, RefusesOtherThingsByName) {
  const TempFolder folder;
  const auto what = [&](const std::string& bytes) {
    return read_image(folder.write("a", bytes)).error().what;
  };
  EXPECT_THAT(what("BM\x36\0\0\0"s), HasSubstr("BMP"));
  EXPECT_THAT(what("\xFF\xD8\xFF\xE0"), HasSubstr("JPEG"));
  EXPECT_THAT(what("P6\n1 1\n255\n..."), HasSubstr("P6"));
  EXPECT_THAT(what(""), HasSubstr("empty"));
  EXPECT_THAT(what("image: a.pgm"), HasSubstr("no picture"));
  EXPECT_THAT(read_image(folder.path("")).error().what, HasSubstr("directory"));
  EXPECT_THAT(read_image(folder.path("gone")).error().what, HasSubstr("no such file"));
  EXPECT_THAT(read_image("/dev/zero").error().what, HasSubstr("not a regular file"));
}

TEST(MapImage, RefusesSizesThatTheFileCannotHoldBeforeAllocating) {
  const TempFolder folder;
  for (const std::string& bytes :
       {"P5\n65536 65536\n255\nx"s, "P5\n4294967295 4294967295\n255\nx"s, "P5\n20000 19999\n255\nx"s,
        "P5\n2 2\n65535\nabcdefg"s, "P2\n20000 19999\n255\n1"s, "P5\n99999999999999999999 1\n255\nx"s,
        "P5\n0 5\n255\n"s, "P5\n5 0\n255\n"s, "P5\n1 1\n0\nx"s, "P5\n1 1\n65536\nxx"s, "P5\n-1 -1\n255\nx"s,
        "P5\n1 1\n"s, "P5"s, "P2"s, png({60000, 60000, 8, 0}, "\0\x01"s),
        png({20000, 19999, 8, 0}, "\0\x01"s), png({20000, 19999, 16, 6}, "\0"s)}) {
    const auto image = read_image(folder.write("a", bytes));
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().where, HasSubstr(folder.path("a")));
  }
}

TEST(MapImage, RefusesAChunkThatLeadsPastTheEndOfAPng) {
  const TempFolder folder;
  std::string text = png_chunk("tEXt", "a\0b"s);
  const auto read = [&] { return read_image(folder.write("a", png({1, 1, 8, 0}, "\0\x01"s, text))); };
  ASSERT_TRUE(read());
  text[0] = '\x3B';  // nearly a gibibyte
  ASSERT_FALSE(read());
  EXPECT_THAT(read().error().what, HasSubstr("more than the file has left"));
  const std::string whole = png({1, 1, 8, 0}, "\0\x01"s);
  EXPECT_TRUE(read_image(folder.write("a", whole + "what follows the last chunk, whatever it is")))
      << "is not read";
}

/// Reads every beginning of a file, and the file with bytes changed: an answer each time, with a consistent
/// picture.
void maltreat(const std::string& bytes, int whole_from) {
  const TempFolder folder;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto image = read_image(folder.write("a", bytes.substr(0, size)));
    if (static_cast<int>(size) < whole_from) {
      EXPECT_FALSE(image) << size;
    }
  }
  Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    std::string changed = bytes;
    for (int k = 0; k <= i % 4; ++k) changed[rng.bits() % changed.size()] = static_cast<char>(rng.bits());
    const auto image = read_image(folder.write("a", changed));
    if (!image) continue;
    EXPECT_EQ(image->shades.size(),
              static_cast<std::size_t>(image->width_px) * static_cast<std::size_t>(image->height_px));
    EXPECT_TRUE(image->opacity.empty() || image->opacity.size() == image->shades.size());
  }
}

TEST(MapImage, SurvivesDamagedPgm) {
  const std::string binary = p5(7, 5, std::string(35, 'x'));
  maltreat(binary, static_cast<int>(binary.size()));
  const std::string plain = "P2\n# made by hand\n3 2\n255\n10 20 30\n40 50 6";
  maltreat(plain, static_cast<int>(plain.size()));
}

TEST(MapImage, SurvivesDamagedPng) {
  const std::string rows = "\0\x01\x02\x03\x04\0\x05\x06\x07\x08"s;
  const std::string gray = png({4, 2, 8, 0}, rows);
  maltreat(gray, static_cast<int>(gray.size()) - 30);  // what follows the last pixel is not needed
  maltreat(png({2, 2, 8, 4}, rows), 0);
  maltreat(png({2, 2, 8, 0, 1}, "\0\x01\0\x02\0\x03\x04"s), 0);
}

}  // namespace
}  // namespace beaconless::io
