// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// A scan as a line of points that windows may slide over without thinking of its ends.
///
/// Before the first beam and after the last come `pad` more places: on a full circle the beams from the other
/// end, else places without a hit. Place p is beam (p - pad). `run_first[p]` and `run_last[p]` end the run of
/// hits around p: an invalid beam breaks a neighbourhood. Where there is no hit, the run is empty.
class UnrolledScan {
 public:
  /// Allocates only when the scan has more beams than any before. Cost: two passes over the beams.
  void assign(const Scan& scan, std::size_t pad);

  std::size_t begin() const { return pad_; }         ///< place of the first beam
  std::size_t end() const { return pad_ + beams_; }  ///< after the place of the last beam
  std::size_t size() const { return x_m.size(); }    ///< with the padding
  bool is_hit(std::size_t place) const { return run_first[place] <= place; }
  Eigen::Vector2d point(std::size_t place) const { return {x_m[place], y_m[place]}; }

  std::vector<float> x_m;  ///< sensor frame; 0 where there is no hit
  std::vector<float> y_m;
  std::vector<std::uint32_t> run_first;
  std::vector<std::uint32_t> run_last;

 private:
  std::size_t pad_ = 0;
  std::size_t beams_ = 0;
};

}  // namespace beaconless
