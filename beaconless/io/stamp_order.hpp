// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "beaconless/core/stamp.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Watches the stamps of the scans go by, and says once what is wrong with their order.
class StampOrder {
 public:
  void see(Stamp stamp, const std::string& where) {
    if (last_ && stamp <= *last_) {
      if (repeats_ + backward_ == 0) first_ = where;
      ++(stamp == *last_ ? repeats_ : backward_);
    }
    last_ = stamp;
  }

  std::uint64_t repeats() const { return repeats_; }
  std::uint64_t backward() const { return backward_; }

  /// One Problem for the whole pass, if there is any; a second call says nothing.
  void report_once(const std::function<void(const Problem&)>& on_problem) {
    if (said_ || repeats_ + backward_ == 0) return;
    said_ = true;
    if (on_problem)
      on_problem({first_, std::to_string(repeats_) + " scan stamps repeat and " + std::to_string(backward_) +
                              " run backwards, here first; the order of the file is kept"});
  }

 private:
  std::optional<Stamp> last_;
  std::uint64_t repeats_ = 0;
  std::uint64_t backward_ = 0;
  std::string first_;
  bool said_ = false;
};

}  // namespace beaconless::io
