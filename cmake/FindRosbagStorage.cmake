# SPDX-License-Identifier: Apache-2.0
# Finds librosbag_storage of ROS 1 (Debian: librosbag-storage-dev) and makes RosbagStorage::RosbagStorage.
#
# Not by find_package(rosbag_storage): that runs Python (catkin, ament) at configure time, and its list of libraries
# lacks roscpp_serialization and rostime.
find_path(RosbagStorage_INCLUDE_DIR rosbag/bag.h)
find_path(RosbagStorage_ROSTIME_INCLUDE_DIR ros/time.h)
find_path(RosbagStorage_BZIP2_INCLUDE_DIR bzlib.h)
set(rosbag_storage_needed RosbagStorage_INCLUDE_DIR RosbagStorage_ROSTIME_INCLUDE_DIR
    RosbagStorage_BZIP2_INCLUDE_DIR)

foreach(library IN ITEMS rosbag_storage roscpp_serialization rostime cpp_common roslz4 console_bridge bz2)
  find_library(RosbagStorage_${library}_LIBRARY ${library})
  list(APPEND rosbag_storage_needed RosbagStorage_${library}_LIBRARY)
endforeach()

# rosbag/bag.h includes pluginlib, whose headers and those behind them Debian puts one folder too deep.
set(rosbag_storage_includes "${RosbagStorage_INCLUDE_DIR}" "${RosbagStorage_ROSTIME_INCLUDE_DIR}"
    "${RosbagStorage_BZIP2_INCLUDE_DIR}")
foreach(package IN ITEMS pluginlib class_loader rcpputils rcutils ament_index_cpp console_bridge)
  if(EXISTS "${RosbagStorage_INCLUDE_DIR}/${package}/${package}")
    list(APPEND rosbag_storage_includes "${RosbagStorage_INCLUDE_DIR}/${package}")
  endif()
endforeach()
list(REMOVE_DUPLICATES rosbag_storage_includes)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(RosbagStorage REQUIRED_VARS ${rosbag_storage_needed})
mark_as_advanced(${rosbag_storage_needed})

if(RosbagStorage_FOUND AND NOT TARGET RosbagStorage::RosbagStorage)
  add_library(RosbagStorage::RosbagStorage INTERFACE IMPORTED GLOBAL)
  target_include_directories(RosbagStorage::RosbagStorage SYSTEM INTERFACE ${rosbag_storage_includes})
  target_link_libraries(RosbagStorage::RosbagStorage INTERFACE
    ${RosbagStorage_rosbag_storage_LIBRARY} ${RosbagStorage_roscpp_serialization_LIBRARY}
    ${RosbagStorage_rostime_LIBRARY} ${RosbagStorage_cpp_common_LIBRARY} ${RosbagStorage_roslz4_LIBRARY}
    ${RosbagStorage_console_bridge_LIBRARY} ${RosbagStorage_bz2_LIBRARY})
endif()
