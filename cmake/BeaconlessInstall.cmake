# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` copies, so that others can write find_package(beaconless).
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/beaconless")

install(DIRECTORY beaconless DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
if(EXISTS "${PROJECT_SOURCE_DIR}/data")
  install(DIRECTORY data/ DESTINATION "${CMAKE_INSTALL_DATADIR}/beaconless")
endif()
if(TARGET beaconless_cli)
  install(TARGETS beaconless_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()

get_property(targets GLOBAL PROPERTY BEACONLESS_TARGETS)
install(TARGETS ${targets} EXPORT beaconlessTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT beaconlessTargets NAMESPACE beaconless:: DESTINATION "${package_dir}")

# Static libraries hand their dependencies on: a user's CMake has to find them as ours did.
install(FILES cmake/FindLZ4.cmake cmake/FindZstd.cmake DESTINATION "${package_dir}")
set(BEACONLESS_HAS_ROSBAG1 OFF)
if(TARGET beaconless_rosbag1)
  set(BEACONLESS_HAS_ROSBAG1 ON)
  install(FILES cmake/FindRosbagStorage.cmake DESTINATION "${package_dir}")
endif()
configure_package_config_file(cmake/beaconlessConfig.cmake.in "${PROJECT_BINARY_DIR}/beaconlessConfig.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/beaconlessConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/beaconlessConfig.cmake" "${PROJECT_BINARY_DIR}/beaconlessConfigVersion.cmake"
        DESTINATION "${package_dir}")
