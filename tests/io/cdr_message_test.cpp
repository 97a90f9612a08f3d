// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/cdr_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

#include "cdr_writer.hpp"
#include "recording_samples.hpp"

namespace beaconless {
namespace {

namespace cdr = io::cdr;
using testing::HasSubstr;
using testing::SizeIs;

const std::endian kOrders[] = {std::endian::little, std::endian::big};

/// The bits of floats: NaN equals NaN.
std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

struct Sample {
  MessageBytes bytes;
  bool (*decodes)(std::span<const unsigned char>);
};

std::vector<Sample> one_of_each(std::endian order) {
  const io::FrameTransform wheels{
      {5'000'000'006}, "odom", "base_link", {1.0, 2.0, 0.0}, {0.8, 0.0, 0.0, 0.6}};
  return {{cdr_of(sample_scans(1, 12).front(), order),
           [](auto bytes) { return bool(cdr::decode_laser_scan(bytes)); }},
          {cdr_of(Odometry{{7}, {1.0, 2.0, 3.0}, Twist2{0.1, 0.2, 0.3}, ""}, order),
           [](auto bytes) { return bool(cdr::decode_odometry(bytes)); }},
          {cdr_of(ReferencePose{{7}, {1.0, 2.0, 3.0}, {}, ""}, 0, order),
           [](auto bytes) { return bool(cdr::decode_pose_stamped(bytes)); }},
          {cdr_of(ReferencePose{{7}, {1.0, 2.0, 3.0}, {}, ""}, 36, order),
           [](auto bytes) { return bool(cdr::decode_pose_with_covariance_stamped(bytes)); }},
          {cdr_of({wheels, wheels}, order), [](auto bytes) { return bool(cdr::decode_transforms(bytes)); }}};
}

TEST(CdrMessage, AScanLiesAsItIsSpecified) {
  // Written by hand after the layout that Fast-CDR and @foxglove/rosmsg2-serialization agree on: 72 bytes.
  const MessageBytes bytes{
      0, 1, 0,    0,                                               // plain CDR, little-endian
      1, 0, 0,    0,    2,   0,   0,    0,                         // 1 s, 2 ns
      6, 0, 0,    0,    'l', 'a', 's',  'e',  'r', 0, 0,    0,     // a text and two bytes of padding
      0, 0, 0x80, 0xBF, 0,   0,   0x80, 0x3F, 0,   0, 0,    0x3F,  // -1, 1, 0.5
      0, 0, 0,    0,    0,   0,   0,    0x3E, 0,   0, 0x80, 0x3E, 0, 0, 0x20, 0x41,  // 0, 0.125, 0.25, 10
      3, 0, 0,    0,    0,   0,   0x80, 0x3F, 0,   0, 0,    0x40, 0, 0, 0x80, 0x7F,  // ranges 1, 2, inf
      0, 0, 0,    0};                                                                // no intensities
  ASSERT_THAT(bytes, SizeIs(72));
  const auto scan = cdr::decode_laser_scan(bytes).value();
  EXPECT_EQ(scan.stamp.ns, 1'000'000'002);
  EXPECT_EQ(scan.frame_id, "laser");
  EXPECT_EQ(scan.angle_min_rad, -1.0F);
  EXPECT_EQ(scan.angle_increment_rad, 0.5F);
  EXPECT_EQ(scan.scan_time_s, 0.125F);
  EXPECT_EQ(scan.range_min_m, 0.25F);
  EXPECT_EQ(scan.range_max_m, 10.0F);
  EXPECT_THAT(scan.ranges_m, testing::ElementsAre(1.0F, 2.0F, std::numeric_limits<float>::infinity()));
  EXPECT_THAT(scan.intensities, testing::IsEmpty());
}

TEST(CdrMessage, EveryFieldComesBackInEitherByteOrder) {
  for (const std::endian order : kOrders) {
    for (const char* frame : {"", "l", "la", "las", "lase", "laser"}) {  // each alignment after the text
      RawScan scan = sample_scans(1, 20).front();
      scan.frame_id = frame;
      const auto back = cdr::decode_laser_scan(cdr_of(scan, order)).value();
      EXPECT_EQ(back.stamp, scan.stamp);
      EXPECT_EQ(back.frame_id, scan.frame_id);
      EXPECT_EQ(back.time_increment_s, scan.time_increment_s);
      EXPECT_EQ(back.range_max_m, scan.range_max_m);
      EXPECT_EQ(bits_of(back.ranges_m), bits_of(scan.ranges_m));
      EXPECT_EQ(bits_of(back.intensities), bits_of(scan.intensities));
    }
    const Odometry odometry{{1'663'967'375'865'899'650}, {1.0, 2.0, 0.5}, Twist2{0.1, 0.2, 0.3}, ""};
    const auto wheels = cdr::decode_odometry(cdr_of(odometry, order)).value();
    EXPECT_EQ(wheels.stamp, odometry.stamp);
    EXPECT_EQ(wheels.twist_per_s, odometry.twist_per_s);
    EXPECT_LT(distance_m(wheels.odom_from_base, odometry.odom_from_base), 1e-12);
    EXPECT_NEAR(wheels.odom_from_base.theta_rad, 0.5, 1e-12);
    const ReferencePose pose{{3}, {4.0, 5.0, -0.5}, {}, ""};
    EXPECT_NEAR(cdr::decode_pose_stamped(cdr_of(pose, 0, order))->map_from_base.theta_rad, -0.5, 1e-12);
    EXPECT_EQ(cdr::decode_pose_with_covariance_stamped(cdr_of(pose, 36, order))->map_from_base.y_m, 5.0);
  }
}

TEST(CdrMessage, TransformsKeepTheirFrames) {
  const io::FrameTransform wheels{{5}, "odom", "base_link", {1.0, 2.0, 0.0}, {0.8, 0.0, 0.0, 0.6}};
  const io::FrameTransform wheel{{5}, "base_link", "left_wheel", {0.0, 0.1, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  for (const std::endian order : kOrders) {
    const auto transforms = cdr::decode_transforms(cdr_of({wheel, wheels}, order)).value();
    ASSERT_THAT(transforms, SizeIs(2));
    EXPECT_EQ(transforms[0].child, "left_wheel");
    EXPECT_EQ(transforms[0].translation_m, wheel.translation_m);
    const auto odometry = io::odometry_of(transforms);
    ASSERT_THAT(odometry, SizeIs(1));
    EXPECT_EQ(odometry[0].source, "odom->base_link");
    EXPECT_NEAR(odometry[0].odom_from_base.theta_rad, 2.0 * std::atan2(0.6, 0.8), 1e-12);
  }
}

TEST(CdrMessage, CutAnywhereItIsRefused) {
  for (const std::endian order : kOrders)
    for (const Sample& sample : one_of_each(order)) {
      EXPECT_TRUE(sample.decodes(sample.bytes));
      for (std::size_t size = 0; size < sample.bytes.size(); ++size)
        EXPECT_FALSE(sample.decodes(std::span(sample.bytes).first(size))) << size;
    }
}

TEST(CdrMessage, PaddingAtTheEndIsLetPassAndMoreIsNot) {
  for (Sample& sample : one_of_each(std::endian::little)) {
    sample.bytes.resize(sample.bytes.size() + 3);
    EXPECT_TRUE(sample.decodes(sample.bytes));
    sample.bytes.push_back(0);
    EXPECT_FALSE(sample.decodes(sample.bytes));
  }
}

TEST(CdrMessage, OtherEncapsulationsAreNamed) {
  MessageBytes bytes = cdr_of(sample_scans(1, 3).front());
  bytes[1] = 7;  // CDR version 2
  EXPECT_THAT(cdr::decode_laser_scan(bytes).error().what, HasSubstr("header says 0 7"));
}

TEST(CdrMessage, APromiseOfFourBillionAllocatesNothing) {
  for (const std::endian order : kOrders) {
    CdrWriter scan(order);
    scan.stamp({0}).text("");
    for (int i = 0; i < 7; ++i) scan.put(0.0F);
    EXPECT_FALSE(cdr::decode_laser_scan(scan.put(0xFFFFFFFFU).bytes()));
    EXPECT_FALSE(cdr::decode_laser_scan(CdrWriter(order).stamp({0}).put(0xFFFFFFFFU).bytes()));
    EXPECT_FALSE(cdr::decode_transforms(CdrWriter(order).put(0xFFFFFFFFU).bytes()));
  }
}

TEST(CdrMessage, NoiseAndMutationsNeverDecodeBeyondTheirEnd) {
  Rng rng(7);
  for (int i = 0; i < 20'000; ++i) {
    MessageBytes bytes(rng.bits() % 120);
    for (auto& byte : bytes) byte = rng.uniform() < 0.7 ? 0 : static_cast<unsigned char>(rng.bits());
    if (bytes.size() > 1) bytes[0] = 0, bytes[1] = static_cast<unsigned char>(rng.bits() % 2);
    for (const Sample& sample : one_of_each(std::endian::little)) (void)sample.decodes(bytes);
  }
  for (const Sample& sample : one_of_each(std::endian::big))
    for (int i = 0; i < 5'000; ++i) {
      MessageBytes bytes = sample.bytes;
      for (int k = 0; k < 3; ++k) bytes[rng.bits() % bytes.size()] = static_cast<unsigned char>(rng.bits());
      (void)sample.decodes(bytes);
    }
}

}  // namespace
}  // namespace beaconless
