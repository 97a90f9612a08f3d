// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io::ros1 {

/// Decoders of ROS 1 messages as they lie in bags and on the wire: little-endian, packed, strings and arrays
/// behind their uint32 length.
///
/// Errors (without a place): the bytes end early or are too many, a pose is not finite. A length is compared
/// with the bytes that are there before anything is allocated. Source: wiki.ros.org/ROS/Technical Overview,
/// message serialization.
Result<RawScan> decode_laser_scan(std::span<const unsigned char> bytes);  ///< sensor_msgs/LaserScan
Result<Odometry> decode_odometry(std::span<const unsigned char> bytes);   ///< nav_msgs/Odometry
Result<ReferencePose> decode_pose_stamped(
    std::span<const unsigned char> bytes);  ///< geometry_msgs/PoseStamped
/// geometry_msgs/PoseWithCovarianceStamped; the covariance is not kept.
Result<ReferencePose> decode_pose_with_covariance_stamped(std::span<const unsigned char> bytes);

/// tf/tfMessage and tf2_msgs/TFMessage, as they were sent; `odometry_of` takes out the dead reckoning.
Result<std::vector<FrameTransform>> decode_transforms(std::span<const unsigned char> bytes);

}  // namespace beaconless::io::ros1
