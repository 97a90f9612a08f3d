// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>
#include <string>

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// What is wrong at present, in words, one thing a subject: for /diagnostics, and for the log when it is new.
class Complaints {
 public:
  struct Complaint {
    Level level = Level::warn;
    std::string words;
    double until_s = 0.0;
    double logged_s = 0.0;
  };

  static constexpr double kForGood = std::numeric_limits<double>::infinity();
  static constexpr double kSayAgain_s = 30.0;

  /// Complains, for some time or until it is cleared. Whether that belongs into the log: not what has just
  /// been said there of the same subject.
  bool raise(const std::string& subject, Level level, std::string words, double now_s,
             double lasts_s = kForGood);

  void clear(const std::string& subject) { all_.erase(subject); }

  /// Those that still hold, by subject.
  const std::map<std::string, Complaint>& at(double now_s);

 private:
  std::map<std::string, Complaint> all_;
};

}  // namespace beaconless::ros1
