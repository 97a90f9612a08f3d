// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// Writes a file so that at every moment, a loss of power included, the old one or the new one is there
/// whole.
///
/// The bytes go to `path`.part beside it, to the disk, and then take its name. Errors: the reason of the
/// operating system; the old file is still there then. Cost: waits for the disk.
Result<Done> write_file_atomically(const std::string& path, std::string_view bytes);

/// A file, or a folder of files, that takes its name when it is whole: until then it is called `path`.part,
/// and it is removed when nobody keeps it.
class PartFile {
 public:
  /// Makes nothing yet: what `part()` names is the caller's to write. `end` follows ".part", for those who
  /// look at the end of a name.
  explicit PartFile(std::string path, std::string_view end = {})
      : path_(std::move(path)), part_(path_ + ".part" + std::string(end)) {}
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile();

  const std::string& path() const { return path_; }  ///< in the end
  const std::string& part() const { return part_; }  ///< until then

  /// Brings it to the disk and gives it its name; a file of that name is replaced, a folder only if it is
  /// empty. Errors: the reason of the operating system. Cost: waits for the disk.
  Result<Done> keep();

 private:
  std::string path_;
  std::string part_;
  bool is_kept_ = false;
};

}  // namespace beaconless::io
