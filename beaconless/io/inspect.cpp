// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace beaconless::io {
namespace {

constexpr double kJump_mps = 5.0;
constexpr double kJump_radps = 10.0;
constexpr double kMoved_m = 0.01;
constexpr double kSameOffset_m = 0.02;
constexpr double kSameOffset_rad = radians(1.0);
constexpr std::size_t kMaxSources = 1000;

/// Every k-th of a stream of values, k doubling so that the sample stays small; enough for medians.
template <class T>
class Sample {
 public:
  void add(T value) {
    if (seen_++ % step_ != 0) return;
    values_.push_back(std::move(value));
    if (values_.size() < kMost) return;
    for (std::size_t i = 0; 2 * i < values_.size(); ++i) values_[i] = values_[2 * i];
    values_.resize(values_.size() / 2);
    step_ *= 2;
  }
  const std::vector<T>& values() const { return values_; }

 private:
  static constexpr std::size_t kMost = 8192;
  std::vector<T> values_;
  std::uint64_t seen_ = 0;
  std::uint64_t step_ = 1;
};

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// How often each range is met, in centimetres.
class RangeCounts {
 public:
  void add(float range_m) {
    const auto cell = static_cast<std::size_t>(std::min(static_cast<double>(range_m) * 100.0, kCells - 1.0));
    ++counts_[cell];
    last_ = std::max(last_, cell);
  }

  /// A range that many beams share and that nothing comes near from below: the scanner's word for nothing
  /// seen.
  void find_cap(RecordingSummary& summary) const {
    const auto from = static_cast<std::size_t>(0.99 * static_cast<double>(last_));
    const auto below = static_cast<std::size_t>(0.98 * static_cast<double>(last_));
    std::uint64_t near = 0;
    std::uint64_t top = 0;
    std::size_t most = last_;
    for (std::size_t i = below; i <= last_; ++i) {
      (i < from ? near : top) += counts_[i];
      if (i >= from && counts_[i] > counts_[most]) most = i;
    }
    if (top < 20 || summary.share(top) < 0.002 || top < 10 * (near + 1)) return;
    summary.capped_at_m = static_cast<double>(most) / 100.0;
    summary.capped_share = summary.share(top);
  }

 private:
  static constexpr double kCells = 30'000.0;  // 300 m
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(static_cast<std::size_t>(kCells));
  std::size_t last_ = 0;
};

class PoseWatch {
 public:
  void see(Stamp stamp, const Pose2& pose) {
    ++source_.count;
    if (source_.count > 1) {
      const double moved_m = distance_m(last_pose_, pose);
      const double turned_rad = heading_difference_rad(last_pose_, pose);
      const double time_s = seconds_between(last_stamp_, stamp);
      source_.path_length_m += moved_m;
      if (time_s > 0.0 &&
          (moved_m > kJump_mps * time_s + kMoved_m || turned_rad > kJump_radps * time_s + kMoved_m))
        ++source_.jumps;
      if (time_s == 0.0 && moved_m >= kMoved_m) ++source_.moves_without_time;
    }
    last_stamp_ = stamp;
    last_pose_ = pose;
  }

  void see_offset(const Pose2& base_from_laser) { offsets_.add(base_from_laser); }

  PoseSource result(const std::string& name) const {
    PoseSource source = source_;
    source.name = name;
    if (offsets_.values().empty()) return source;
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> cosines;
    std::vector<double> sines;
    for (const Pose2& offset : offsets_.values()) {
      x.push_back(offset.x_m);
      y.push_back(offset.y_m);
      cosines.push_back(std::cos(offset.theta_rad));
      sines.push_back(std::sin(offset.theta_rad));
    }
    const Pose2 median{quantile(x, 0.5), quantile(y, 0.5),
                       std::atan2(quantile(sines, 0.5), quantile(cosines, 0.5))};
    std::vector<double> far_m;
    std::vector<double> far_rad;
    for (const Pose2& offset : offsets_.values()) {
      far_m.push_back(distance_m(median, offset));
      far_rad.push_back(heading_difference_rad(median, offset));
    }
    source.base_from_laser = median;
    source.is_base_from_laser_constant =
        quantile(far_m, 0.95) < kSameOffset_m && quantile(far_rad, 0.95) < kSameOffset_rad;
    return source;
  }

 private:
  PoseSource source_;
  Stamp last_stamp_;
  Pose2 last_pose_;
  Sample<Pose2> offsets_;
};

class Summarizer {
 public:
  explicit Summarizer(RecordingSummary& summary) : summary_(summary) {}

  void see(const Scan& scan) {
    if (summary_.scans++ == 0)
      see_first(scan);
    else
      see_interval(scan.stamp());
    last_stamp_ = scan.stamp();
    summary_.last_stamp = std::max(summary_.last_stamp, scan.stamp());
    summary_.least_beams = std::min(summary_.least_beams, scan.size());
    summary_.most_beams = std::max(summary_.most_beams, scan.size());
    if (scan.size() > 1 && scan.beam_time_s(0) != scan.beam_time_s(1)) summary_.tells_beam_times = true;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      switch (scan.beams()[i]) {
        case Beam::hit:
          ranges_.add(scan.ranges_m()[i]);
          break;
        case Beam::no_return:
          ++summary_.no_returns;
          break;
        case Beam::too_close:
          ++summary_.too_close;
          break;
        case Beam::invalid:
          ++summary_.invalid;
          break;
      }
      summary_.longest_hit_m = std::max(summary_.longest_hit_m, static_cast<double>(scan.ranges_m()[i]));
    }
    summary_.hits += scan.hit_count();
  }

  void see(const Odometry& odometry) {
    if (PoseWatch* watch = of(odometry_, odometry.source))
      watch->see(odometry.stamp, odometry.odom_from_base);
  }

  void see(const ReferencePose& reference) {
    PoseWatch* watch = of(references_, reference.source);
    if (!watch) return;
    watch->see(reference.stamp, reference.map_from_base);
    if (reference.base_from_laser) watch->see_offset(*reference.base_from_laser);
  }

  void finish() {
    summary_.duration_s = seconds_between(summary_.first_stamp, summary_.last_stamp);
    const double median_s = quantile(intervals_s_.values(), 0.5);
    summary_.rate_hz = median_s > 0.0 ? 1.0 / median_s : 0.0;
    for (const double interval_s : intervals_s_.values())
      if (interval_s > std::max(1.0, 5.0 * median_s)) ++summary_.gaps;
    ranges_.find_cap(summary_);
    for (const auto& [name, watch] : odometry_) summary_.odometry.push_back(watch.result(name));
    for (const auto& [name, watch] : references_) summary_.references.push_back(watch.result(name));
  }

 private:
  using Watches = std::map<std::string, PoseWatch>;

  static PoseWatch* of(Watches& watches, const std::string& source) {
    if (watches.size() >= kMaxSources && !watches.contains(source)) return nullptr;
    return &watches[source];
  }

  void see_first(const Scan& scan) {
    summary_.first_stamp = summary_.last_stamp = scan.stamp();
    summary_.least_beams = summary_.most_beams = scan.size();
    summary_.frame_id = scan.frame_id();
    summary_.angle_min_rad = scan.angle_min_rad();
    summary_.angle_increment_rad = scan.angle_increment_rad();
    summary_.field_of_view_rad = scan.angle_rad(scan.size() - 1) - scan.angle_min_rad();
    summary_.range_min_m = scan.range_min_m();
    summary_.range_max_m = scan.range_max_m();
  }

  void see_interval(Stamp stamp) {
    const double interval_s = seconds_between(last_stamp_, stamp);
    if (interval_s == 0.0) ++summary_.repeated_stamps;
    if (interval_s < 0.0) ++summary_.backward_stamps;
    if (interval_s >= 0.0) intervals_s_.add(interval_s);
    summary_.longest_gap_s = std::max(summary_.longest_gap_s, interval_s);
  }

  RecordingSummary& summary_;
  Stamp last_stamp_;
  Sample<double> intervals_s_;
  RangeCounts ranges_;
  Watches odometry_;
  Watches references_;
};

}  // namespace

RecordingSummary summarize(const Recording& recording) {
  RecordingSummary summary;
  summary.path = recording.path();
  summary.format = recording.format();
  summary.scan_topic = recording.scan_topic();
  summary.topics = recording.topics();
  summary.laser_place = recording.laser_place();
  Summarizer summarizer(summary);
  const auto pass = recording.open_pass();
  while (const auto event = pass->next()) std::visit([&](const auto& e) { summarizer.see(e); }, *event);
  summary.skipped_records = pass->skipped();
  summarizer.finish();
  return summary;
}

}  // namespace beaconless::io
