// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/ros_schemas.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "beaconless/io/ros_events.hpp"

namespace beaconless::io {
namespace {

/// A message's fields, and the messages among them.
struct Definition {
  std::string_view name;  ///< without "msg/"
  std::string_view fields;
  std::vector<std::string_view> parts;
};

const std::vector<Definition>& definitions() {
  static const std::vector<Definition> kAll{
      {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n", {}},
      {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n", {"builtin_interfaces/Time"}},
      {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n", {}},
      {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", {}},
      {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", {}},
      {"geometry_msgs/Pose",
       "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
       {"geometry_msgs/Point", "geometry_msgs/Quaternion"}},
      {"geometry_msgs/PoseWithCovariance",
       "geometry_msgs/Pose pose\nfloat64[36] covariance\n",
       {"geometry_msgs/Pose"}},
      {"geometry_msgs/Twist",
       "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n",
       {"geometry_msgs/Vector3"}},
      {"geometry_msgs/TwistWithCovariance",
       "geometry_msgs/Twist twist\nfloat64[36] covariance\n",
       {"geometry_msgs/Twist"}},
      {"geometry_msgs/Transform",
       "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
       {"geometry_msgs/Vector3", "geometry_msgs/Quaternion"}},
      {"geometry_msgs/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
       {"std_msgs/Header", "geometry_msgs/Transform"}},
      {"geometry_msgs/PoseStamped",
       "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
       {"std_msgs/Header", "geometry_msgs/Pose"}},
      {"geometry_msgs/PoseWithCovarianceStamped",
       "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n",
       {"std_msgs/Header", "geometry_msgs/PoseWithCovariance"}},
      {"sensor_msgs/LaserScan",
       "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
       "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\n"
       "float32[] intensities\n",
       {"std_msgs/Header"}},
      {"nav_msgs/Odometry",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
       "geometry_msgs/TwistWithCovariance twist\n",
       {"std_msgs/Header", "geometry_msgs/PoseWithCovariance", "geometry_msgs/TwistWithCovariance"}},
      {"tf2_msgs/TFMessage",
       "geometry_msgs/TransformStamped[] transforms\n",
       {"geometry_msgs/TransformStamped"}},
      {"diagnostic_msgs/KeyValue", "string key\nstring value\n", {}},
      {"diagnostic_msgs/DiagnosticStatus",
       "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n"
       "string hardware_id\ndiagnostic_msgs/KeyValue[] values\n",
       {"diagnostic_msgs/KeyValue"}},
      {"diagnostic_msgs/DiagnosticArray",
       "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
       {"std_msgs/Header", "diagnostic_msgs/DiagnosticStatus"}}};
  return kAll;
}

const Definition* find(std::string_view name) {
  for (const Definition& definition : definitions())
    if (definition.name == name) return &definition;
  return nullptr;
}

/// What ROS 1 writes otherwise: its time is a primitive, and its Header counts.
constexpr std::string_view kTime = "builtin_interfaces/Time";
constexpr std::string_view kHeader = "std_msgs/Header";
constexpr std::string_view kRos1Header = "uint32 seq\ntime stamp\nstring frame_id\n";

/// All that a message is made of, each once.
void gather(const Definition& of, std::vector<const Definition*>& found) {
  for (const std::string_view name : of.parts) {
    const Definition* part = find(name);
    if (part == nullptr || std::find(found.begin(), found.end(), part) != found.end()) continue;
    found.push_back(part);
    gather(*part, found);
  }
}

std::string schema(std::string_view name, bool is_ros1) {
  const Definition* definition = find(short_type(name));
  if (definition == nullptr) return "";
  std::vector<const Definition*> parts;
  gather(*definition, parts);
  std::string text(definition->fields);
  for (const Definition* part : parts) {
    if (is_ros1 && part->name == kTime) continue;
    const auto fields = is_ros1 && part->name == kHeader ? kRos1Header : part->fields;
    text.append(80, '=').append("\nMSG: ").append(part->name).append("\n").append(fields);
  }
  return text;
}

}  // namespace

std::string ros2_schema(std::string_view name) { return schema(name, false); }
std::string ros1_schema(std::string_view name) { return schema(name, true); }

std::string_view ros1_md5(std::string_view name) {
  using Sum = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Sum, 4> kSums{{{"sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369"},
                                      {"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"},
                                      {"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"},
                                      {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"}}};
  const std::string wanted = short_type(name);
  const auto* const found =
      std::find_if(kSums.begin(), kSums.end(), [&](const Sum& sum) { return sum.first == wanted; });
  return found == kSums.end() ? std::string_view() : found->second;
}

}  // namespace beaconless::io
