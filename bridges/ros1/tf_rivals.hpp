// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// What others tell on tf that does not go along with what a localizer tells there, in words.
///
/// In tf a frame has one parent. Who tells another parent of odom or base, or of the map itself, as a
/// recording with its own localizer does, breaks the tree for everybody.
class TfRivals {
 public:
  TfRivals(std::string map_frame, std::string odom_frame, std::string base_frame);

  /// A transform that another node told; a static one holds for ever, others for ten seconds.
  void hear(const TransformMessage& told, const std::string& teller, bool is_static, double now_s);

  /// Who tells the map below odom or base: a loop, if the node told its own.
  std::optional<std::string> loop(double now_s) const;

  /// Who tells that child as well, which the node is about to tell below the map.
  std::optional<std::string> beside(const std::string& child, double now_s) const;

 private:
  struct Told {
    std::string parent;
    std::string teller;
    double until_s = 0.0;
  };

  const Told* of(const std::string& child, double now_s) const;

  std::string map_frame_, odom_frame_, base_frame_;
  std::map<std::string, Told> told_;  // by the child: map, odom and base only
};

}  // namespace beaconless::ros1
