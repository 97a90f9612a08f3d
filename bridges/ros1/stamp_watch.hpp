// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/core/stamp.hpp"

namespace beaconless::ros1 {

/// How a scan's stamp follows from the one before.
enum class StampOrder {
  follows,
  repeated,     ///< the same once more
  earlier,      ///< overtaken on its way
  jumped_back,  ///< a clock was set back, or a recording began anew
};

/// Watches the stamps of one stream of scans.
class StampWatch {
 public:
  static constexpr double kJump_s = 1.0;  ///< no message is overtaken by so much

  StampOrder see(Stamp stamp) {
    if (last_ && stamp == *last_) return StampOrder::repeated;
    if (last_ && stamp < *last_ && seconds_between(stamp, *last_) < kJump_s) return StampOrder::earlier;
    const bool is_back = last_ && stamp < *last_;
    last_ = stamp;
    return is_back ? StampOrder::jumped_back : StampOrder::follows;
  }

 private:
  std::optional<Stamp> last_;
};

}  // namespace beaconless::ros1
