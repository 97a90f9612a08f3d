// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace beaconless::io {

/// Puts values as they lie, little-endian and packed, at the end of a string of bytes; what McapReader takes.
class ByteWriter {
  static_assert(std::endian::native == std::endian::little, "values are copied as they lie");

 public:
  explicit ByteWriter(std::string& out) : out_(out) {}

  template <class T>
  void put(T value) {
    out_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  void bytes(std::string_view bytes) { out_.append(bytes); }

  /// Behind its length.
  void text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    out_.append(text);
  }

 private:
  std::string& out_;
};

}  // namespace beaconless::io
