// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace beaconless::ros1 {

/// What became of a parameter of ROS's amcl here.
struct AmclName {
  std::string_view name;
  std::string_view ours;    ///< the parameter that it sets; "" where there is none
  std::string_view remark;  ///< why it has none
};

/// All that amcl knows and the node does not have under the same name.
std::span<const AmclName> amcl_names();

/// What a name means that amcl knows; nothing for others. Source: wiki.ros.org/amcl, section Parameters.
std::optional<AmclName> amcl_name(std::string_view name);

}  // namespace beaconless::ros1
