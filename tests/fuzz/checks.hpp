// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

#include "tests/fuzz/readers.hpp"

namespace beaconless::fuzz {

struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws BrokenPromise with `what` where it does not hold.
void require(bool holds, const char* what);

/// A folder of this process in the temporary one; the same names are written again and again.
class InputFolder {
 public:
  InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;
  ~InputFolder();

  std::string write(const std::string& name, Bytes bytes) const;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// That an error says where and what.
void check(const Error& error);
/// Every number is finite, every range a hit within its limits or one of the kinds of nothing.
void check(const Event& event);

using OpenRecording =
    std::function<Result<io::Recording>(const std::string& path, const io::RecordingOptions& options)>;

/// Reads the bytes as a recording in two passes that must see the same events.
void read_recording(const OpenRecording& open, Bytes bytes);

}  // namespace beaconless::fuzz
