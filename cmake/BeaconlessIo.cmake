# SPDX-License-Identifier: Apache-2.0
# The library of beaconless/io and what it stands on.
find_package(yaml-cpp REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(LZ4 REQUIRED)
find_package(Zstd REQUIRED)

set(rosbag1_sources rosbag1_bag.cpp rosbag1_survey.cpp rosbag1_writer.cpp)
beaconless_module(io PUBLIC beaconless_map beaconless_sim PRIVATE yaml-cpp ZLIB::ZLIB PNG::PNG nlohmann_json::nlohmann_json
                  fmt::fmt SQLite::SQLite3 LZ4::LZ4 Zstd::Zstd EXCLUDE ${rosbag1_sources})

# ROS 1 bags: everything that includes ROS is behind this one C++17 library, whose headers are plain structs.
if(BEACONLESS_WITH_ROSBAG1)
  find_package(RosbagStorage QUIET)
  if(RosbagStorage_FOUND)
    list(TRANSFORM rosbag1_sources PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/io/")
    add_library(beaconless_rosbag1 STATIC ${rosbag1_sources})
    set_target_properties(beaconless_rosbag1 PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON
                          POSITION_INDEPENDENT_CODE ON EXPORT_NAME rosbag1)
    target_include_directories(beaconless_rosbag1 PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                               $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(beaconless_rosbag1 PRIVATE $<BUILD_INTERFACE:beaconless_build_flags>
                          RosbagStorage::RosbagStorage)
    add_library(beaconless::rosbag1 ALIAS beaconless_rosbag1)
    set_property(GLOBAL APPEND PROPERTY BEACONLESS_TARGETS beaconless_rosbag1)
    target_link_libraries(beaconless_io PRIVATE beaconless_rosbag1)
    target_compile_definitions(beaconless_io PRIVATE BEACONLESS_HAS_ROSBAG1)
  else()
    message(STATUS "ROS 1 bags can be neither read nor written by this build: install librosbag-storage-dev to change that")
  endif()
endif()
