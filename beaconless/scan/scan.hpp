// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/result.hpp"
#include "beaconless/core/stamp.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless {

/// What became of one beam.
enum class Beam : std::uint8_t {
  hit,        ///< a range that can be used
  no_return,  ///< nothing within range: the way was free (+inf, or a range at or beyond range_max_m)
  too_close,  ///< nearer than range_min_m (or -inf)
  invalid,    ///< no information (NaN, 0, negative)
};

/// Which moment of the sweep RawScan::stamp means. ROS says the first beam; many drivers stamp the end.
enum class StampIs { first_beam, middle_beam, last_beam };

/// What Scan::make may assume.
struct ScanGate {
  StampIs stamp_is = StampIs::first_beam;
  double sweep_time_s =
      0.0;  ///< from the first beam to the last, against what the source tells; 0: believe it
  float range_min_m = 0.0F;  ///< raises the sensor's own lower limit; 0: leave it
  float range_max_m = 0.0F;  ///< lowers the sensor's own upper limit; 0: leave it
};

/// One sweep of a 2-D laser scanner behind the gate: beams run counter-clockwise over at most one turn, and
/// everything that is not a hit is marked. Nobody behind this class needs to test for NaN.
class Scan {
 public:
  /// Settles the sensor mess once: the sign of the angle step, the doubled beam at 360°, over-full turns, NaN
  /// and ±inf (REP 117), ranges outside the limits, a stamp at the end of the sweep.
  ///
  /// Errors: no beams, more than kMaxBeams, an angle step of zero or not finite, limits that exclude
  /// everything, intensities of another length. Cost: one sine and cosine per beam. Source:
  /// sensor_msgs/LaserScan, REP 117. Differs: a range equal to range_max_m counts as no return, as many
  /// drivers use it so, and so does one beyond 100 km where no limit is told. A time per beam that is
  /// negative, not finite or makes a sweep of over a minute counts as not told, and so does such a gate's.
  static Result<Scan> make(RawScan raw, const ScanGate& gate = {});

  static constexpr std::size_t kMaxBeams = 1'000'000;

  Stamp stamp() const { return stamp_; }  ///< of the first beam in time
  const std::string& frame_id() const { return frame_id_; }
  std::size_t size() const { return ranges_m_.size(); }
  std::size_t hit_count() const { return hit_count_; }

  double angle_min_rad() const { return angle_min_rad_; }
  double angle_increment_rad() const { return angle_increment_rad_; }  ///< always > 0
  double angle_rad(std::size_t beam) const {
    return angle_min_rad_ + static_cast<double>(beam) * angle_increment_rad_;
  }
  /// Whether the beam after the last one is the first one again, so that neighbourhoods run over the end.
  bool is_full_circle() const;
  double range_min_m() const { return range_min_m_; }
  double range_max_m() const { return range_max_m_; }  ///< infinity when no limit is known
  double scan_time_s() const { return scan_time_s_; }

  /// Seconds from stamp() to the moment of a beam; 0 for all where the source tells no time per beam.
  double beam_time_s(std::size_t beam) const {
    return first_beam_time_s_ + static_cast<double>(beam) * time_increment_s_;
  }

  std::span<const Beam> beams() const { return beams_; }
  std::span<const float> ranges_m() const { return ranges_m_; }  ///< 0 where not a hit
  std::span<const float> x_m() const { return x_m_; }            ///< sensor frame; 0 where not a hit
  std::span<const float> y_m() const { return y_m_; }
  std::span<const float> intensities() const { return intensities_; }  ///< empty, or one a beam, all finite

  /// Seconds from the first beam to the last; 0 where the source tells no time per beam.
  double sweep_time_s() const { return std::abs(time_increment_s_) * static_cast<double>(size() - 1); }

  /// At which beam a point lies, with the fraction to the next one: in [0, beams of a whole turn), so it may
  /// lie beyond the last beam. In: sensor frame.
  double beams_towards(const Eigen::Vector2d& point) const;

  bool is_hit(std::size_t beam) const { return beams_[beam] == Beam::hit; }
  Eigen::Vector2d point(std::size_t beam) const { return {x_m_[beam], y_m_[beam]}; }
  Eigen::Vector2d direction(std::size_t beam) const;

  friend bool operator==(const Scan&, const Scan&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Scan& scan);

 private:
  Scan() = default;

  Stamp stamp_;
  std::string frame_id_;
  double angle_min_rad_ = 0.0;
  double angle_increment_rad_ = 0.0;
  double range_min_m_ = 0.0;
  double range_max_m_ = 0.0;
  double scan_time_s_ = 0.0;
  double first_beam_time_s_ = 0.0;
  double time_increment_s_ = 0.0;
  std::size_t hit_count_ = 0;
  std::vector<Beam> beams_;
  std::vector<float> ranges_m_;
  std::vector<float> x_m_;
  std::vector<float> y_m_;
  std::vector<float> intensities_;
};

}  // namespace beaconless
