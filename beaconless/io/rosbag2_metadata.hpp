// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/io/rosbag2_writer.hpp"

namespace beaconless::io {

/// The metadata.yaml of a bag with one file, `file_name`, that has been written.
///
/// Source: rosbag2_storage of Humble, version 5.
std::string rosbag2_metadata(const Rosbag2Writer& bag, const std::string& file_name);

}  // namespace beaconless::io
