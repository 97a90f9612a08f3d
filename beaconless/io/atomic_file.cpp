// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace beaconless::io {
namespace {

/// A file descriptor that is closed once.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

bool write_all(int number, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(number, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Error failed(const std::string& path) {
  return {path, std::string("cannot be written: ") + std::strerror(errno),
          "is there such a folder, and room in it?"};
}

bool is_synced(const std::string& path) {
  const Descriptor file(path, O_RDONLY);
  return file.is_open() && fsync(file.number()) == 0;
}

/// A new name is safe once its folder is on the disk too; where that cannot be asked for, it comes in time.
void sync_names(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (const Descriptor names(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY); names.is_open())
    fsync(names.number());
}

}  // namespace

Result<Done> write_file_atomically(const std::string& path, std::string_view bytes) {
  const std::string part = path + ".part";
  Descriptor file(part, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) return failed(path);
  if (!write_all(file.number(), bytes) || fsync(file.number()) != 0 || !file.close() ||
      std::rename(part.c_str(), path.c_str()) != 0) {
    const Error error = failed(path);
    unlink(part.c_str());
    return error;
  }
  sync_names(path);
  return Done{};
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!is_kept_) std::filesystem::remove_all(part_, ignored);
}

Result<Done> PartFile::keep() {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(part_, error))
    for (const auto& entry : fs::directory_iterator(part_, error))
      if (!is_synced(entry.path().string())) return failed(path_);
  if (!is_synced(part_) || std::rename(part_.c_str(), path_.c_str()) != 0) return failed(path_);
  is_kept_ = true;
  sync_names(path_);
  return Done{};
}

}  // namespace beaconless::io
