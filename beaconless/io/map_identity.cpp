// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/map_identity.hpp"

#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {
namespace {

/// The hash of a file's bytes, going on from `hash`; pictures of maps may be large.
Result<std::uint64_t> hash_file(const std::string& path, std::uint64_t hash) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 65536> block{};
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    hash = fnv1a({block.data(), static_cast<std::size_t>(in.gcount())}, hash);
  if (!in.eof()) return Error{path, "cannot be read", "is it there, and may you read it?"};
  return hash;
}

}  // namespace

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

Result<MapIdentity> identify_map(const std::string& path) {
  const auto yaml = read_yaml(path);
  if (!yaml) return yaml.error();
  auto hash = hash_file(path, fnv1a({}));
  if (!hash) return hash.error();
  if (const YamlNode* image = yaml->find("image")) {
    hash = hash_file((std::filesystem::path(path).parent_path() / image->text).string(), *hash);
    if (!hash) return hash.error();
  }
  return MapIdentity{std::filesystem::path(path).filename().string(), *hash};
}

std::string hash_text(std::uint64_t hash) { return fmt::format("fnv1a-{:016x}", hash); }

}  // namespace beaconless::io
