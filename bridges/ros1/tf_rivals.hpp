// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// What others tell on tf that does not go along with what a localizer tells there, in words.
///
/// In tf a frame has one parent. Who tells another parent of odom or base, or of the map itself, as a
/// recording with its own localizer does, breaks the tree for everybody.
class TfRivals {
 public:
  TfRivals(std::string map_frame, std::string odom_frame, std::string base_frame);

  /// A transform that another node told. It holds for ten seconds, a static one for good: whoever heard it
  /// goes by it, even when its teller has ended. What tf itself would not take is passed over.
  void hear(const TransformMessage& told, const std::string& teller, bool is_static, double now_s);

  void forget() { told_.clear(); }  ///< all, as tf does under a new master

  /// Who has put the map below that child, which the node would tell below the map: a loop.
  std::optional<std::string> loop(const std::string& child, double now_s) const;

  /// Who tells that child as well, or two parents of odom or base.
  std::optional<std::string> beside(const std::string& child, double now_s) const;

 private:
  struct Told {
    std::string parent;
    bool is_static = false;
    double until_s = 0.0;
  };
  using ByTeller = std::map<std::string, Told>;

  const ByTeller& of(const std::string& child) const;
  bool leads_up(const std::string& from, const std::string& to, double now_s,
                std::set<std::string>& seen) const;

  std::string map_frame_, odom_frame_, base_frame_;
  std::map<std::string, ByTeller> told_;  // by child
};

}  // namespace beaconless::ros1
