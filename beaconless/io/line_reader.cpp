// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/line_reader.hpp"

#include <cerrno>
#include <cstring>

#include <zlib.h>

#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr std::size_t kBufferBytes = 64U << 10U;

gzFile gz(void* file) { return static_cast<gzFile>(file); }

}  // namespace

void LineReader::Close::operator()(void* gz_file) const { gzclose_r(gz(gz_file)); }

Result<LineReader> LineReader::open(const std::string& path, std::function<void(const Problem&)> on_problem) {
  if (const auto size = file_size_bytes(path); !size) return size.error();
  LineReader reader;
  reader.path_ = path;
  reader.on_problem_ = std::move(on_problem);
  reader.file_.reset(gzopen(path.c_str(), "rb"));
  if (!reader.file_) return Error{path, std::string("cannot be opened: ") + std::strerror(errno), ""};
  reader.buffer_.resize(kBufferBytes);
  return reader;
}

bool LineReader::fill() {
  if (!file_) return false;
  const int count = gzread(gz(file_.get()), buffer_.data(), static_cast<unsigned>(buffer_.size()));
  if (count > 0) {
    unread_ = {buffer_.data(), static_cast<std::size_t>(count)};
    return true;
  }
  int code = Z_OK;
  const char* reason = gzerror(gz(file_.get()), &code);
  if (code == Z_BUF_ERROR)
    report("the compressed data end early; the rest of the recording is missing");
  else if (code != Z_OK && code != Z_STREAM_END)
    report(std::string("the compressed data are damaged (") + reason + "); nothing after this can be read");
  file_.reset();
  return false;
}

std::optional<std::string_view> LineReader::next() {
  for (;;) {
    line_.clear();
    bool too_long = false;
    bool any = false;
    is_cut_ = true;
    for (;;) {
      if (unread_.empty() && !fill()) break;
      any = true;
      const std::size_t end = unread_.find('\n');
      const std::string_view piece = unread_.substr(0, end);
      too_long = too_long || line_.size() + piece.size() > kMaxLineBytes;
      if (!too_long) line_ += piece;
      unread_.remove_prefix(end == std::string_view::npos ? unread_.size() : end + 1);
      is_cut_ = end == std::string_view::npos;
      if (!is_cut_) break;
    }
    if (!any) return std::nullopt;
    ++line_number_;
    if (too_long) {
      report("the line is longer than " + std::to_string(kMaxLineBytes >> 20U) + " MiB and is passed over");
      continue;
    }
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    return line_;
  }
}

void LineReader::report(const std::string& what) const {
  if (on_problem_) on_problem_({where(), what});
}

}  // namespace beaconless::io
