// SPDX-License-Identifier: Apache-2.0
// What is kept of the moments before a robot loses its way.
#include "beaconless/io/black_box.hpp"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/yaml_tree.hpp"

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBegin_ns = 1'411'657'682'042'859'001;

/// A drive of a scan and an odometry reading a second, told to a black box.
class BlackBoxDrive : public testing::Test {
 protected:
  BlackBoxDrive() { raw_ = sample_scans(1, 61).front(); }

  void begin(const BlackBoxConfig& config) {
    box_.emplace(folder.path("boxes"),
                 BlackBoxAbout{.start = "1,2,3",
                               .lines = {{"map", "hall: 1.yaml"}},
                               .command_options = " --map 'hall: 1.yaml'",
                               .config_yaml = "method: walls\n"},
                 config);
  }
  void drive(std::size_t scans, Status status, double quality = 0.9) {
    for (std::size_t i = 0; i < scans; ++i) {
      raw_.stamp = Stamp{kBegin_ns + kSecond_ns * static_cast<std::int64_t>(scans_)};
      std::rotate(raw_.ranges_m.begin(), raw_.ranges_m.begin() + 1, raw_.ranges_m.end());
      const Scan scan = Scan::make(raw_).value();
      PoseEstimate estimate{.stamp = scan.stamp(),
                            .map_from_base = {0.1 * static_cast<double>(scans_), 0.0, 1.0},
                            .status = status,
                            .reason = "because",
                            .quality = quality};
      scans_told.push_back(scan);
      estimates_told.push_back(estimate);
      ++scans_;
      note(box_->update(scan, estimate));
      estimate.status = Status::not_a_scan;
      note(box_->update(Odometry{scan.stamp() + 0.5, {0.1, 0.2, 0.3}, {}, "ODOM"}, estimate));
    }
  }
  void note(const Result<std::optional<WrittenBox>>& box) {
    ASSERT_TRUE(box) << box.error();
    if (*box) boxes.push_back((*box)->folder);
  }

  TempFolder folder;
  std::optional<BlackBox> box_;
  std::vector<std::string> boxes;
  std::vector<Scan> scans_told;
  std::vector<PoseEstimate> estimates_told;

 private:
  RawScan raw_;
  std::size_t scans_ = 0;
};

TEST_F(BlackBoxDrive, WritesWhatHappenedBeforeAndAfterBitForBit) {
  begin({.keep_s = 5.2, .scans_after = 3});
  drive(20, Status::ok);
  drive(2, Status::lost, 0.1);
  EXPECT_THAT(boxes, IsEmpty());
  drive(5, Status::lost, 0.1);
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_THAT(boxes.front(), testing::EndsWith("/1411657702.042859001_lost"));
  // The scan that was lost is the 21st, three more come after it, and of those before five seconds are kept.
  const Pass pass = pass_over(boxes.front() + "/recording.log");
  ASSERT_FALSE(pass.error) << *pass.error;
  ASSERT_THAT(pass.scans, SizeIs(6));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(pass.scans[i].stamp(), scans_told[18 + i].stamp());
  EXPECT_TRUE(std::equal(pass.scans.front().ranges_m().begin(), pass.scans.front().ranges_m().end(),
                         scans_told[18].ranges_m().begin()));
  EXPECT_THAT(pass.odometry, SizeIs(5));
  const auto estimates = read_estimates_csv(boxes.front() + "/estimates.csv").value();
  ASSERT_THAT(estimates, SizeIs(6));
  EXPECT_EQ(estimates[1].map_from_base, estimates_told[19].map_from_base);
  const auto why = read_yaml(boxes.front() + "/why.yaml").value();
  EXPECT_EQ(why.find("reason")->text, "lost, quality 0.10: because");
  EXPECT_EQ(why.find("map")->text, "hall: 1.yaml");
  EXPECT_THAT(why.find("start")->text, testing::StartsWith("1.8"));
  EXPECT_THAT(why.find("replay")->text,
              HasSubstr("recording.log --map 'hall: 1.yaml' --config config.yaml --start=1.8"));
}

TEST_F(BlackBoxDrive, FromTheBeginningOfARunItStartsAsTheRunDid) {
  begin({.scans_after = 0});
  drive(3, Status::ok);
  drive(1, Status::relocalizing, 0.4);
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_EQ(read_yaml(boxes.front() + "/why.yaml").value().find("start")->text, "1,2,3");
}

TEST_F(BlackBoxDrive, OnlyWhatWasFoundCanBeLost) {
  begin({.scans_after = 0});
  drive(10, Status::relocalizing, 0.9);
  drive(10, Status::lost, 0.0);
  EXPECT_THAT(boxes, IsEmpty());
  drive(1, Status::ok);
  drive(10, Status::lost, 0.0);
  EXPECT_THAT(boxes, SizeIs(1)) << "one for each time";
  drive(1, Status::ok);
  drive(1, Status::lost, 0.0);
  EXPECT_THAT(boxes, SizeIs(2));
}

TEST_F(BlackBoxDrive, QualityThatStaysLowIsAReason) {
  begin({.scans_after = 0, .low_quality_scans = 3});
  drive(1, Status::ok);
  for (int i = 0; i < 5; ++i) {
    drive(2, Status::ok, 0.49);
    drive(1, Status::ok, 0.5);
  }
  EXPECT_THAT(boxes, IsEmpty());
  drive(2, Status::degraded, 0.49);
  EXPECT_THAT(boxes, IsEmpty());
  drive(1, Status::ok, 0.49);
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_THAT(boxes.front(), testing::EndsWith("_low_quality"));
}

TEST_F(BlackBoxDrive, TheEndOfTheRunDoesNotSwallowABox) {
  begin({.scans_after = 10});
  drive(3, Status::ok);
  drive(2, Status::lost, 0.0);
  EXPECT_THAT(boxes, IsEmpty());
  note(box_->finish());
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_THAT(read_estimates_csv(boxes.front() + "/estimates.csv").value(), SizeIs(5));
  note(box_->finish());
  EXPECT_THAT(boxes, SizeIs(1));
}

TEST_F(BlackBoxDrive, KeepsNoMoreThanItMay) {
  begin({.keep_s = 1e9, .most_scans = 4, .scans_after = 0});
  drive(50, Status::ok);
  drive(1, Status::lost, 0.0);
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_THAT(pass_over(boxes.front() + "/recording.log").scans, SizeIs(4));
  begin({.keep_s = 1e9, .most_events = 7, .scans_after = 0});
  drive(50, Status::ok);
  drive(1, Status::lost, 0.0);
  EXPECT_LE(pass_over(boxes.back() + "/recording.log").events.size(), 7U);
}

TEST_F(BlackBoxDrive, WritesNoMoreBoxesThanItMayAndReplacesNone) {
  begin({.scans_after = 0, .most_boxes = 2});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(box_->is_full(), i > 2);
    drive(1, Status::ok);
    drive(1, Status::lost, 0.0);
  }
  EXPECT_THAT(boxes, SizeIs(2));
  EXPECT_TRUE(box_->is_full());
}

TEST_F(BlackBoxDrive, TheSameMomentGetsAnotherName) {
  std::filesystem::create_directories(folder.path("boxes/1411657683.042859001_lost"));
  begin({.scans_after = 0});
  drive(1, Status::ok);
  drive(1, Status::lost, 0.0);
  ASSERT_THAT(boxes, SizeIs(1));
  EXPECT_THAT(boxes.front(), testing::EndsWith("1411657683.042859001_lost_2"));
}

TEST_F(BlackBoxDrive, ADiskThatRefusesIsToldAndTheNextBoxIsTried) {
  folder.write("boxes", "a file where the folder should be");
  begin({.scans_after = 1});
  drive(1, Status::ok);
  drive(1, Status::lost, 0.0);
  const auto refused = box_->finish();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().remedy, HasSubstr("--blackbox"));
  std::filesystem::remove(folder.path("boxes"));
  drive(1, Status::ok);
  drive(2, Status::lost, 0.0);
  EXPECT_THAT(boxes, SizeIs(1));
}

}  // namespace
}  // namespace beaconless::io
