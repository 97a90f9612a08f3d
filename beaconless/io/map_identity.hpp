// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// Which map it is: poses mean something on the map they were found on only.
struct MapIdentity {
  std::string name;        ///< of the YAML file, without its folder
  std::uint64_t hash = 0;  ///< of the bytes of the YAML and of the picture it names

  friend bool operator==(const MapIdentity&, const MapIdentity&) = default;
};

/// The hash of some bytes, going on from that of those before. Source: FNV-1a, 64 bits.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325U);

/// The identity of a map's files. Errors: those of reading them. Cost: reads both once.
Result<MapIdentity> identify_map(const std::string& path);

/// A hash as it stands in files: 16 hexadecimal digits behind "fnv1a-".
std::string hash_text(std::uint64_t hash);

}  // namespace beaconless::io
