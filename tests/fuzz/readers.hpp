// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace beaconless::fuzz {

using Bytes = std::span<const unsigned char>;

// Each hands the bytes to a reader as a stranger's file, takes all that comes, and throws BrokenPromise where
// that is not what the reader's documentation promises.
void read_carmen(Bytes bytes);       ///< a CARMEN log, plain or gzipped
void read_echo(Bytes bytes);         ///< the text of `rostopic echo`
void read_mcap(Bytes bytes);         ///< an MCAP file
void read_messages(Bytes bytes);     ///< the first byte chooses CDR or ROS 1 and the type; one message
void read_picture(Bytes bytes);      ///< the first byte chooses how a grid is made of it; PGM or PNG
void read_rosbag1(Bytes bytes);      ///< a ROS 1 bag
void read_rosbag2(Bytes bytes);      ///< the SQLite file of a ROS 2 bag
void read_small_files(Bytes bytes);  ///< the first byte chooses among the small text formats
void read_zstd(Bytes bytes);         ///< the same, compressed as a whole

}  // namespace beaconless::fuzz
