# SPDX-License-Identifier: Apache-2.0
# Finds what a node of ROS 1 needs, as Debian has it, and makes Ros1::Ros1.
#
# Not by find_package(roscpp): that runs Python (catkin, ament) at configure time.
set(ros1_needed)
foreach(header IN ITEMS ros/ros.h tf2_ros/transform_listener.h sensor_msgs/LaserScan.h nav_msgs/SetMap.h
                        visualization_msgs/Marker.h diagnostic_msgs/DiagnosticArray.h std_srvs/Trigger.h)
  string(MAKE_C_IDENTIFIER "Ros1_${header}" variable)
  find_path(${variable} ${header})
  list(APPEND ros1_needed ${variable})
endforeach()
set(ros1_libraries)
foreach(library IN ITEMS tf2_ros tf2 actionlib message_filters roscpp rosconsole roscpp_serialization rostime xmlrpcpp
                         cpp_common boost_thread boost_system)
  find_library(Ros1_${library}_LIBRARY ${library})
  list(APPEND ros1_needed Ros1_${library}_LIBRARY)
  list(APPEND ros1_libraries "${Ros1_${library}_LIBRARY}")
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Ros1 REQUIRED_VARS ${ros1_needed})
mark_as_advanced(${ros1_needed})

if(Ros1_FOUND AND NOT TARGET Ros1::Ros1)
  add_library(Ros1::Ros1 INTERFACE IMPORTED)
  target_include_directories(Ros1::Ros1 SYSTEM INTERFACE "${Ros1_ros_ros_h}")
  target_link_libraries(Ros1::Ros1 INTERFACE ${ros1_libraries})
endif()
