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

/// The same of a ROS 1 message that ros1_encode.hpp writes, as bags hold it.
///
/// Source: common_msgs and geometry2 of ROS 1.
std::string ros1_schema(std::string_view name);

/// The MD5 sum by which ROS 1 knows such a message; "" for another name.
std::string_view ros1_md5(std::string_view name);

}  // namespace beaconless::io
