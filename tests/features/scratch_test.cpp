// SPDX-License-Identifier: Apache-2.0
// What every function with buffers of the caller's promises: the same result whatever they were used for
// before, and no memory asked for once they have grown.
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "beaconless/features/circles.hpp"
#include "beaconless/features/detector.hpp"
#include "beaconless/features/merge.hpp"
#include "beaconless/features/segment_by_kalman.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/full_circle.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// A number that tells two lists of results apart.
class Digest {
 public:
  void add(double value) { sum_ = 0.7310585786 * sum_ + value; }
  void add(const Eigen::Vector2d& point) {
    add(point.x());
    add(point.y());
  }
  void add(const ScanSegment& segment) {
    add(static_cast<double>(segment.first));
    add(static_cast<double>(segment.count));
  }
  void add(const Keypoint& keypoint) {
    add(static_cast<double>(keypoint.beam));
    add(keypoint.point);
    add(keypoint.orientation_rad);
    add(keypoint.scale_m);
    add(keypoint.score);
  }
  void add(const Corner& corner) {
    add(keypoint_of(corner));
    add(corner.covariance.sum());
  }
  void add(const ScanCircle& circle) {
    add(circle.beams);
    add(circle.fit.circle.centre);
  }
  template <class Value>
  void add(const std::vector<Value>& list) {
    add(static_cast<double>(list.size()));
    for (const Value& value : list) add(value);
  }
  double value() const { return sum_; }

 private:
  double sum_ = 1.0;
};

/// One function with its buffers.
struct Reuser {
  std::string name;
  std::function<double(const Scan&)> run;
};

/// Buffers that hold what is made of each scan.
template <class Scratch, class Value, class Run>
Reuser reuser(std::string name, Run run) {
  auto scratch = std::make_shared<Scratch>();
  auto out = std::make_shared<std::vector<Value>>();
  return {std::move(name), [scratch, out, run](const Scan& scan) {
            run(scan, *scratch, *out);
            Digest digest;
            digest.add(*out);
            return digest.value();
          }};
}

struct MergeBuffers {
  SplitScratch split;
  DistanceSegmentationScratch segmentation;
  MergeScratch merge;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
};

std::vector<Reuser> all() {
  std::vector<Reuser> reusers;
  reusers.push_back(reuser<DetectorScratch, Keypoint>(
      "all detectors in turn",
      [config = DetectorsConfig{}](const Scan& scan, DetectorScratch& scratch, std::vector<Keypoint>& out) {
        for (const DetectorName& of : detectors()) detect(scan, of.detector, config, scratch, out);
      }));
  for (const DetectorName& of : detectors())
    reusers.push_back(reuser<DetectorScratch, Keypoint>(
        std::string(of.name), [detector = of.detector, config = DetectorsConfig{}](
                                  const Scan& scan, DetectorScratch& scratch, std::vector<Keypoint>& out) {
          detect(scan, detector, config, scratch, out);
        }));
  reusers.push_back(reuser<KalmanSegmentationScratch, ScanSegment>(
      "segment_by_kalman", [](const Scan& scan, KalmanSegmentationScratch& scratch,
                              std::vector<ScanSegment>& out) { segment_by_kalman(scan, {}, scratch, out); }));
  reusers.push_back(reuser<MergeBuffers, ScanSegment>(
      "merge", [](const Scan& scan, MergeBuffers& of, std::vector<ScanSegment>& out) {
        segment_by_distance(scan, {}, of.segmentation, of.segments);
        split(scan, of.segments, {}, of.split, of.pieces);
        merge(scan, of.pieces, {}, of.merge, out);
      }));
  reusers.push_back(reuser<CirclesScratch, ScanCircle>(
      "find_circles", [](const Scan& scan, CirclesScratch& scratch, std::vector<ScanCircle>& out) {
        find_circles(scan, {}, scratch, out);
      }));
  reusers.push_back(reuser<CornersScratch, Corner>(
      "find_crossings", [](const Scan& scan, CornersScratch& scratch, std::vector<Corner>& out) {
        find_corners(scan, {}, scratch, out);
        find_crossings(scan, scratch.lines, {}, out);
      }));
  return reusers;
}

/// Scans of many sizes, with and without gaps, over a sector and over the whole circle.
std::vector<Scan> scans() {
  Rng rng(23);
  const RayCaster walls(test::niche_room().segments());
  std::vector<Scan> scans;
  for (int k = 0; k < 12; ++k) {
    const Pose2 pose{1.5 + 0.3 * k, 1.6, 0.7 * k};
    RawScan raw = k % 3 == 1 ? test::full_circle(walls, pose, 0.01, rng, 300 + 97 * k)
                             : test::sweep(walls, pose, 0.01, rng);
    if (k % 3 == 2) raw.ranges_m.resize(200 + static_cast<std::size_t>(50 * k));
    if (k % 4 == 3)
      for (float& range : raw.ranges_m)
        if (rng.uniform() < 0.05) range = 0.0F;
    scans.push_back(Scan::make(raw).value());
  }
  return scans;
}

TEST(Scratch, LeavesNothingBehind) {
  const std::vector<Scan> seen = scans();
  std::vector<Reuser> used = all();
  for (std::size_t f = 0; f < used.size(); ++f)
    for (const Scan& scan : seen)
      EXPECT_EQ(used[f].run(scan), all()[f].run(scan)) << used[f].name << ", " << scan.size() << " beams";
}

TEST(Scratch, AsksForNothingOnceItHasGrown) {
  const std::vector<Scan> seen = scans();
  for (const Reuser& of : all()) {
    for (const Scan& scan : seen) of.run(scan);
    const std::size_t before = test::allocations();
    for (const Scan& scan : seen) of.run(scan);
    EXPECT_EQ(test::allocations(), before) << of.name;
  }
}

}  // namespace
}  // namespace beaconless
