// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io::cdr {

/// Decoders of ROS 2 messages as they lie in bags and on the wire: CDR of either byte order behind its four
/// byte header, each number aligned to its size.
///
/// Errors (without a place): another encapsulation than plain CDR (version 1), the bytes end early or are too
/// many, a pose is not finite. A length is compared with the bytes that are there before anything is
/// allocated. Up to three bytes of padding at the end are let pass. Source: OMG DDS-RTPS 2.3, 10; CORBA 3.3,
/// 9.3.
Result<RawScan> decode_laser_scan(std::span<const unsigned char> bytes);  ///< sensor_msgs/msg/LaserScan
Result<Odometry> decode_odometry(std::span<const unsigned char> bytes);   ///< nav_msgs/msg/Odometry
Result<ReferencePose> decode_pose_stamped(
    std::span<const unsigned char> bytes);  ///< geometry_msgs/msg/PoseStamped
/// geometry_msgs/msg/PoseWithCovarianceStamped; the covariance is not kept.
Result<ReferencePose> decode_pose_with_covariance_stamped(std::span<const unsigned char> bytes);

/// tf2_msgs/msg/TFMessage, as it was sent; `odometry_of` takes out the dead reckoning.
Result<std::vector<FrameTransform>> decode_transforms(std::span<const unsigned char> bytes);

}  // namespace beaconless::io::cdr
