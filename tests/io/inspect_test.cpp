// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/inspect.hpp"

#include <deque>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording_samples.hpp"

namespace beaconless {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ListStream : public io::EventStream {
 public:
  explicit ListStream(std::deque<Event> events) : events_(std::move(events)) {}
  std::optional<Event> next() override {
    if (events_.empty()) return std::nullopt;
    Event event = events_.front();
    events_.pop_front();
    return event;
  }
  std::uint64_t skipped() const override { return 3; }

 private:
  std::deque<Event> events_;
};

io::RecordingSummary summary_of(const std::deque<Event>& events) {
  return io::summarize(
      io::Recording("path", "format", "scan", {}, [events] { return std::make_unique<ListStream>(events); }));
}

std::vector<std::string> words_about(const std::deque<Event>& events) {
  std::vector<std::string> words;
  for (const io::Finding& finding : io::diagnose(summary_of(events)))
    words.push_back(finding.what + " -> " + finding.remedy);
  return words;
}

Scan scan_at(double time_s, std::vector<float> ranges) {
  RawScan raw;
  raw.stamp = Stamp::from_seconds(time_s);
  raw.angle_min_rad = -1.0F;
  raw.angle_increment_rad = 0.01F;
  raw.range_max_m = 30.0F;
  raw.ranges_m = std::move(ranges);
  return Scan::make(raw).value();
}

std::vector<float> room(std::size_t beams, Rng& rng) {
  std::vector<float> ranges;
  for (std::size_t i = 0; i < beams; ++i) ranges.push_back(static_cast<float>(rng.uniform(1.0, 9.0)));
  return ranges;
}

TEST(Inspect, CountsWhatThereIs) {
  const float nan = std::nanf("");
  std::deque<Event> events;
  for (int i = 0; i < 5; ++i) {
    events.emplace_back(
        ReferencePose{Stamp::from_seconds(i), {1.0 * i, 0.0, 0.0}, Pose2{0.2, 0.1, 0.0}, "A"});
    events.emplace_back(Odometry{Stamp::from_seconds(i), {0.0, 2.0 * i, 0.0}, std::nullopt, "B"});
    events.emplace_back(scan_at(i, {1.0F, 2.0F, 40.0F, nan}));
  }
  const auto s = summary_of(events);
  EXPECT_EQ(s.scans, 5U);
  EXPECT_EQ(s.skipped_records, 3U);
  EXPECT_DOUBLE_EQ(s.duration_s, 4.0);
  EXPECT_DOUBLE_EQ(s.rate_hz, 1.0);
  EXPECT_EQ(s.hits, 10U);
  EXPECT_EQ(s.no_returns, 5U);
  EXPECT_EQ(s.invalid, 5U);
  EXPECT_DOUBLE_EQ(s.share(s.hits), 0.5);
  EXPECT_NEAR(s.field_of_view_rad, 0.03, 1e-6);
  ASSERT_EQ(s.references.size(), 1U);
  EXPECT_DOUBLE_EQ(s.references[0].path_length_m, 4.0);
  EXPECT_EQ(s.references[0].base_from_laser, (Pose2{0.2, 0.1, 0.0}));
  EXPECT_TRUE(s.references[0].is_base_from_laser_constant);
  EXPECT_DOUBLE_EQ(s.odometry.at(0).path_length_m, 8.0);
}

TEST(Inspect, NothingAtAllIsSaid) { EXPECT_THAT(words_about({}), Contains(HasSubstr("no scans"))); }

TEST(Inspect, FindsTheRangeThatMeansNothingSeen) {
  Rng rng(3);
  std::deque<Event> capped, honest;
  for (int i = 0; i < 20; ++i) {
    auto ranges = room(200, rng);
    honest.emplace_back(scan_at(i, ranges));
    for (std::size_t k = 0; k < 20; ++k) ranges[k] = 9.5F;
    capped.emplace_back(scan_at(i, ranges));
  }
  EXPECT_NEAR(summary_of(capped).capped_at_m.value_or(0.0), 9.5, 0.011);  // a cell of a centimetre
  EXPECT_NEAR(summary_of(capped).capped_share, 0.1, 1e-12);
  EXPECT_FALSE(summary_of(honest).capped_at_m);
  EXPECT_THAT(words_about(capped), Contains(HasSubstr("9.5")));
}

TEST(Inspect, SaysWhatIsWrongWithTheStamps) {
  std::deque<Event> events;
  for (const double t : {0.0, 0.1, 0.1, 0.2, 0.15, 0.3, 5.0}) events.emplace_back(scan_at(t, {1.0F, 2.0F}));
  const auto words = words_about(events);
  EXPECT_THAT(words, Contains(HasSubstr("1 scan stamps repeat and 1 run backwards")));
  EXPECT_THAT(words, Contains(HasSubstr("the longest 4.70 s")));
  EXPECT_THAT(words, Contains(HasSubstr("no time per beam")));
}

TEST(Inspect, SaysWhenOdometryCannotBeTrusted) {
  std::deque<Event> jumping, corrected, good;
  for (int i = 0; i < 30; ++i) {
    const Stamp stamp = Stamp::from_seconds(0.1 * i);
    good.emplace_back(Odometry{stamp, {0.1 * i, 0.0, 0.0}, std::nullopt, "O"});
    jumping.emplace_back(Odometry{stamp, {0.1 * i + (i > 15 ? 3.0 : 0.0), 0.0, 0.0}, std::nullopt, "O"});
    corrected.emplace_back(Odometry{stamp, {0.1 * i, 0.0, 0.0}, std::nullopt, "O"});
    corrected.emplace_back(Odometry{stamp, {0.1 * i, 0.05, 0.0}, std::nullopt, "O"});
  }
  EXPECT_THAT(words_about(jumping), Contains(HasSubstr("jumps 1 times")));
  EXPECT_THAT(words_about(corrected), Contains(HasSubstr("looks corrected")));
  EXPECT_THAT(words_about(good), Not(Contains(HasSubstr("odometry of"))));
}

TEST(Inspect, SuggestsWhereTheLaserSits) {
  std::deque<Event> rigid, loose;
  for (int i = 0; i < 30; ++i) {
    const Pose2 base{0.1 * i, 0.0, 0.2 * i};
    rigid.emplace_back(ReferencePose{Stamp::from_seconds(i), base, Pose2{0.25, -0.0001, radians(90.0)}, "L"});
    loose.emplace_back(ReferencePose{Stamp::from_seconds(i), base, Pose2{0.1 * i, 0.0, 0.0}, "L"});
  }
  EXPECT_THAT(words_about(rigid), Contains(HasSubstr("--base-from-laser 0.250,0.000,90.0")));
  EXPECT_THAT(words_about(loose), Contains(HasSubstr("not rigidly connected")));
}

TEST(Inspect, NamesWhatTheCorrectedLogsAreKnownFor) {
  const std::string path = [] {
    const char* named = std::getenv("BEACONLESS_DATA");
    return std::string(named ? named : BEACONLESS_SOURCE_DIR "/../shared/data") +
           "/duke_loop5/loop5.carmen.log.gz";
  }();
  const auto recording = io::open_recording(path);
  if (!recording) GTEST_SKIP() << recording.error();
  EXPECT_NEAR(io::summarize(*recording).capped_at_m.value_or(0.0), 8.19, 0.02);  // its README: max range 8.19
}

}  // namespace
}  // namespace beaconless
