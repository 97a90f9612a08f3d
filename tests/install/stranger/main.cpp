// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include <beaconless/io/map_io.hpp>

int main() {
  const beaconless::Pose2 map_from_base{1.2, 3.4, 0.5};
  const auto map = beaconless::io::read_map("there-is-no-such-map.yaml");
  if (map.ok() || beaconless::distance_m(map_from_base, map_from_base.inverse().inverse()) > 1e-12) return 1;
  std::cout << map.error() << '\n';
}
