// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace beaconless::io {

/// The definition of a ROS 2 message that cdr_encode.hpp writes, with those of all it is made of, as the
/// encoding "ros2msg" of MCAP wants it; "" for another name.
///
/// Source: common_interfaces and geometry2 of ROS 2; mcap.dev/spec/registry. Comments are left out.
std::string ros2_schema(std::string_view name);

}  // namespace beaconless::io
