// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "beaconless/io/byte_reader.hpp"

namespace beaconless::io {

/// Takes the primitives of MCAP records one after the other: little-endian, packed, texts behind their
/// length.
class McapReader : public ByteReader {
  static_assert(std::endian::native == std::endian::little, "values are copied as they lie");

 public:
  using ByteReader::ByteReader;

  template <class T>
  T take() {
    T value{};
    if (const auto taken = take_bytes(sizeof(T)); !taken.empty())
      std::memcpy(&value, taken.data(), sizeof(T));
    return value;
  }

  std::string text() {
    const auto taken = bytes(take<std::uint32_t>());
    return {taken.begin(), taken.end()};
  }

  std::span<const unsigned char> bytes(std::uint64_t count) { return take_bytes(count); }
  std::span<const unsigned char> rest() { return take_bytes(left()); }
  using ByteReader::taken;
  bool is_empty() const { return left() == 0; }
};

}  // namespace beaconless::io
