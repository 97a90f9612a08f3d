// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "beaconless/features/four_floats.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {

/// The circle cut into equal sectors from angle 0 on, told from each other without trigonometry. Their number
/// is a multiple of four.
///
/// How far apart two sectors are is the shorter way round. Differs: the public FALKO code takes the C++
/// remainder of a negative number and so gets 9 … 16 where 7 … 0 is right (of 16), whenever an arm points
/// along +x of the sensor.
class AngleSectors {
 public:
  void assign(int count) {
    if (count == this->count()) return;
    a_quarter_ = count / 4;
    slopes_.clear();
    for (int k = 1; k < a_quarter_; ++k)
      slopes_.push_back(static_cast<float>(std::tan(2.0 * kPi * k / count)));
  }

  int count() const { return 4 * a_quarter_; }

  /// The sectors, 0 … count - 1, that four vectors point into.
  Floats4 of(const Floats4& x, const Floats4& y) const {
    // 1. the quarter, and the vector turned back into the first one
    const Ints4 lower = y < 0.0F;
    const Ints4 odd = (x < 0.0F) ^ lower;
    const Floats4 along = where(odd, abs4(y)) + where(~odd, abs4(x));
    const Floats4 across = where(odd, abs4(x)) + where(~odd, abs4(y));
    Ints4 sector = (lower & 2 * a_quarter_) + (odd & a_quarter_);
    // 2. how many limits it is past; a lane that is set counts as -1
    for (const float slope : slopes_) sector -= across >= slope * along;
    return __builtin_convertvector(sector, Floats4);
  }

 private:
  int a_quarter_ = 0;
  std::vector<float> slopes_;  ///< tangents of the limits within the first quarter
};

}  // namespace beaconless
