// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// Counts in how many bins of half a metre and ten degrees poses lie, and in which. Map frame.
///
/// Cost: one look-up in a table of hashes a pose; nothing is allocated once it has grown to the number of
/// poses. Source: the bins of ROS's amcl.
class PoseBins {
 public:
  static constexpr double kBin_m = 0.5;
  static constexpr int kHeadings = 36;
  static constexpr int kNone = -1;

  using Key = std::array<std::int32_t, 3>;  ///< column, row, heading in [0, kHeadings)

  static Key key_of(const Pose2& pose);

  /// Makes room for the bins of so many poses, and empties them.
  void clear(std::size_t poses);

  /// The bin of a pose, counted from 0 in the order in which they were met.
  int add(const Pose2& pose) { return place(key_of(pose), true); }

  /// The bin with a key; kNone where none was met.
  int find(const Key& key) { return place(key, false); }

  std::size_t count() const { return keys_.size(); }
  const Key& key(int bin) const { return keys_[static_cast<std::size_t>(bin)]; }

 private:
  int place(const Key& key, bool adds);

  std::vector<int> table_;  // bins, or kNone; a power of two of them, at most half full
  std::vector<Key> keys_;   // of the bins
};

}  // namespace beaconless
