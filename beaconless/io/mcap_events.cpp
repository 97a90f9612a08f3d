// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_events.hpp"

#include "beaconless/io/cdr_encode.hpp"

namespace beaconless::io {

void McapEventWriter::write(const PoseEstimate& estimate) {
  const Stamp stamp = estimate.stamp;
  events_.put("/beaconless/pose", "geometry_msgs/PoseWithCovarianceStamped", stamp,
              encode_pose_with_covariance_stamped(estimate, "map"));
  events_.put("/tf", "tf2_msgs/TFMessage", stamp,
              encode_transform(stamp, "map", "base_link", estimate.map_from_base));
  events_.put("/diagnostics", "diagnostic_msgs/DiagnosticArray", stamp,
              encode_diagnostics(estimate, "beaconless"));
}

void McapEventWriter::write(const Scan& scan, const PoseEstimate& estimate, const Pose2& base_from_laser,
                            std::string_view topic) {
  place_laser(base_from_laser);
  write(estimate);
  write(scan, topic);
}

Result<Done> McapEventWriter::finish() {
  if (const std::string why = file_.finish(); !why.empty())
    return Error{path_, why, "is there such a folder, and room in it?"};
  return Done{};
}

}  // namespace beaconless::io
