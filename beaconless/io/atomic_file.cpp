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
  // The new name is safe once the folder is on the disk too; where that cannot be asked for, it comes in
  // time.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (const Descriptor names(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY); names.is_open())
    fsync(names.number());
  return Done{};
}

}  // namespace beaconless::io
