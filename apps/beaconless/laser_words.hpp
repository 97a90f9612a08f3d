// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/io/recording.hpp"

namespace beaconless::cli {

/// "/tf_static, base_link -> laser says that the laser sits at -0.040,0.000,90.0 on the robot".
std::string laser_words(const io::LaserPlace& place);

}  // namespace beaconless::cli
