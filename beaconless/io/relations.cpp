// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/relations.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr double kMaxCoordinate_m = 1e9;
constexpr std::size_t kStampWords = 8;  // t1 t2 x y z roll pitch yaw
constexpr std::size_t kScanWords = 5;   // i j x y theta

/// The relation of a line, or what is wrong with it.
struct RelationLine {
  std::optional<PoseRelation> relation;
  std::string what;
};

std::optional<PoseKey> key_of(std::string_view word, bool by_stamp) {
  if (by_stamp) {
    const auto stamp = parse_stamp(word);
    return stamp ? std::optional<PoseKey>(*stamp) : std::nullopt;
  }
  const auto scan = parse_int<std::uint64_t>(word);
  return scan ? std::optional<PoseKey>(*scan) : std::nullopt;
}

RelationLine relation_of(std::span<const std::string_view> words, std::size_t word_count) {
  if (words.size() != word_count)
    return {{},
            "there are " + std::to_string(words.size()) + " words, the others have " +
                std::to_string(word_count)};
  const bool by_stamp = word_count == kStampWords;
  std::array<PoseKey, 2> keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto key = key_of(words[i], by_stamp);
    if (!key)
      return {{}, "\"" + shown(words[i]) + (by_stamp ? "\" is not a time in seconds" : "\" is no scan")};
    keys[i] = *key;
  }
  std::array<double, kStampWords - 2> numbers{};
  for (std::size_t i = 2; i < words.size(); ++i) {
    const auto number = parse_double(words[i]);
    if (!number || !std::isfinite(*number)) return {{}, "\"" + shown(words[i]) + "\" is not a finite number"};
    numbers[i - 2] = *number;
  }
  if (std::abs(numbers[0]) > kMaxCoordinate_m || std::abs(numbers[1]) > kMaxCoordinate_m)
    return {{}, "the relation is longer than 1e9 m"};
  const double yaw_rad = numbers[words.size() - 3];
  return {PoseRelation{keys[0], keys[1], {numbers[0], numbers[1], wrap_angle(yaw_rad)}}, {}};
}

}  // namespace

Result<std::vector<PoseRelation>> read_relations(const std::string& path,
                                                 const std::function<void(const Problem&)>& on_problem) {
  auto text = read_text_table(path);
  if (!text) return text.error();
  std::vector<PoseRelation> relations;
  std::size_t word_count = 0;  // of a line; 0: not known yet
  for_each_row(*text, [&](std::size_t line, std::string_view row) {
    const auto words = split_words(row);
    if (word_count == 0 && (words.size() == kStampWords || words.size() == kScanWords))
      word_count = words.size();
    RelationLine read =
        word_count > 0
            ? relation_of(words, word_count)
            : RelationLine{{}, "there are " + std::to_string(words.size()) + " words, a relation has 8 or 5"};
    if (read.relation) relations.push_back(*read.relation);
    if (!read.what.empty() && on_problem) on_problem({path + ":" + std::to_string(line), read.what});
  });
  if (relations.empty())
    return Error{path, "holds no relation",
                 "a line is: t1 t2 x y z roll pitch yaw (stamps), or: i j x y theta (numbers of scans)"};
  return relations;
}

}  // namespace beaconless::io
