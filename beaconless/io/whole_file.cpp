// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/whole_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace beaconless::io {
namespace {

std::string reason_of_system() {
  return errno == 0 ? "the system gives no reason" : std::generic_category().message(errno);
}

}  // namespace

Result<std::uint64_t> file_size_bytes(const std::string& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found)
    return Error{path, "there is no such file",
                 "check the path; a relative one counts from the working directory"};
  if (error) return Error{path, "cannot be looked at: " + error.message(), ""};
  if (kind == std::filesystem::file_type::directory)
    return Error{path, "is a directory", "name the file inside it"};
  if (kind != std::filesystem::file_type::regular)
    return Error{path, "is not a regular file", "save it to a file first"};
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) return Error{path, "cannot be looked at: " + error.message(), ""};
  return size;
}

Result<std::string> read_whole_file(const std::string& path, std::uint64_t max_bytes) {
  const auto size = file_size_bytes(path);
  if (!size) return size.error();
  if (*size > max_bytes)
    return Error{path,
                 "has " + std::to_string(*size) + " bytes; files of this kind are read up to " +
                     std::to_string(max_bytes),
                 "is it the right file?"};
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) return Error{path, "cannot be opened: " + reason_of_system(), ""};
  std::string bytes(*size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (in.bad()) return Error{path, "cannot be read: " + reason_of_system(), ""};
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

Result<Done> write_whole_file(const std::string& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return Error{path, "cannot be written: " + reason_of_system(), "is there such a folder, and room in it?"};
  return Done{};
}

}  // namespace beaconless::io
