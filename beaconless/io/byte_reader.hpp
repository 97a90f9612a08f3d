// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace beaconless::io {

/// Takes bytes from the front of a message and never more than there are. After the first that do not fit it
/// gives nothing, and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const unsigned char> bytes) : rest_(bytes), size_(bytes.size()) {}

  bool ok() const { return ok_; }

 protected:
  std::span<const unsigned char> take_bytes(std::uint64_t count) {
    ok_ = ok_ && count <= rest_.size();
    if (!ok_) return {};
    const auto bytes = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(static_cast<std::size_t>(count));
    return bytes;
  }

  std::size_t taken() const { return size_ - rest_.size(); }
  std::size_t left() const { return rest_.size(); }

 private:
  std::span<const unsigned char> rest_;
  std::size_t size_;
  bool ok_ = true;
};

}  // namespace beaconless::io
