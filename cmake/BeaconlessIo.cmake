# SPDX-License-Identifier: Apache-2.0
# The library of beaconless/io and what it stands on.
find_package(yaml-cpp REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)

beaconless_module(io PUBLIC beaconless_map beaconless_sim PRIVATE yaml-cpp ZLIB::ZLIB PNG::PNG nlohmann_json::nlohmann_json
                  fmt::fmt EXCLUDE rosbag1_bag.cpp)
