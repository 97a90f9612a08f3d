// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Reads a text file line by line, plain or gzip alike, with memory for one line only.
class LineReader {
 public:
  static constexpr std::size_t kMaxLineBytes = 8U << 20U;  ///< ten times the longest honest scan

  /// Errors: no such file, no regular file, not allowed to read.
  static Result<LineReader> open(const std::string& path,
                                 std::function<void(const Problem&)> on_problem = {});

  /// The next line without its end, valid until the next call; nothing at the end of the file. A line that is
  /// too long and compressed data that end early or are damaged go to `on_problem`.
  std::optional<std::string_view> next();

  bool is_cut() const { return is_cut_; }  ///< the text ended before the line that next() gave last did
  std::uint64_t line_number() const { return line_number_; }  ///< of the line that next() gave last; from 1
  std::string where() const { return path_ + ":" + std::to_string(line_number_); }

 private:
  struct Close {
    void operator()(void* gz_file) const;
  };

  LineReader() = default;
  bool fill();
  void report(const std::string& what) const;

  std::string path_;
  std::function<void(const Problem&)> on_problem_;
  std::unique_ptr<void, Close> file_;
  std::vector<char> buffer_;
  std::string_view unread_;
  std::string line_;
  std::uint64_t line_number_ = 0;
  bool is_cut_ = false;
};

}  // namespace beaconless::io
