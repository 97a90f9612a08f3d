// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/recording.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <zlib.h>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/carmen_log.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/line_reader.hpp"
#include "beaconless/io/mcap_recording.hpp"
#include "beaconless/io/mcap_records.hpp"
#include "beaconless/io/rosbag1_recording.hpp"
#include "beaconless/io/rosbag2_recording.hpp"
#include "beaconless/io/rostopic_echo.hpp"
#include "beaconless/io/text_table.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

using namespace std::string_literals;

constexpr const char* kKnown =
    "known are ROS 2 bags (.db3, .db3.zstd, folders), MCAP files, ROS 1 bags 2.0, CARMEN logs "
    "and the text of `ros2 topic echo` and `rostopic echo`, text also gzipped";

struct Magic {
  std::string bytes;
  const char* what;
  const char* remedy;
};

/// Formats that are recognised in order to say what they are.
const std::vector<Magic>& not_read() {
  static const std::vector<Magic> kList{
      {"\x28\xB5\x2F\xFD"s, "is compressed with zstd", "unpack it with `unzstd` first"},
      {"BZh"s, "is compressed with bzip2", "unpack it with `bunzip2` first"},
      {"\xFD\x37zXZ"s, "is compressed with xz", "unpack it with `unxz` first"},
      {"PK\x03\x04"s, "is a zip archive", "unpack it first"},
      {"%time"s, "is a table that `rostopic echo -p` printed", "echo it again without -p"}};
  return kList;
}

/// Enough for the first block that zstd packs, which gives nothing before it is whole: 128 KiB at most.
std::string raw_head(const std::string& path) {
  constexpr std::size_t kHeadBytes = 160U << 10U;
  std::string head(kHeadBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

std::string unpacked_head(const std::string& path) {
  std::string head(64, '\0');
  gzFile file = gzopen(path.c_str(), "rb");
  const int count = file ? gzread(file, head.data(), static_cast<unsigned>(head.size())) : 0;
  if (file) gzclose_r(file);
  head.resize(static_cast<std::size_t>(std::max(count, 0)));
  return head;
}

bool is_rosbag(std::string_view head) {
  return head.starts_with("#ROSBAG V") || head.starts_with("#ROSRECORD V");
}

/// Foreign bytes, fit for a message.
std::string legible(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out;
}

bool is_tum_row(std::string_view line) {
  const auto words = split_words(line.substr(0, 400));
  return words.size() == 8 && std::all_of(words.begin(), words.end(),
                                          [](std::string_view w) { return parse_double(w).has_value(); });
}

Result<Recording> open_text(const std::string& path, const RecordingOptions& options) {
  constexpr int kLooked = 10'000;
  auto lines = LineReader::open(path);
  if (!lines) return lines.error();
  std::string first;
  for (int i = 0; i < kLooked; ++i) {
    const auto line = lines.value().next();
    if (!line) break;
    std::string_view rest = *line;
    const std::string_view word = take_word(rest);
    if (word.empty() || word.front() == '#') continue;
    if (is_carmen_keyword(word)) return open_carmen_log(path, options);
    if (line->starts_with("header:") || *line == "---") return open_rostopic_echo(path, options);
    if (word == "image:" || word == "walls:") return Error{path, "is a map, not a recording", ""};
    if (is_tum_row(*line))
      return Error{path, "is a trajectory (TUM lines), not a recording", "it can serve as a reference"};
    if (first.empty()) first = legible(*line);
  }
  if (first.empty()) return Error{path, "holds nothing but blank lines and comments", kKnown};
  return Error{path, "is of no known format; it begins with '" + first + "'", kKnown};
}

}  // namespace

Result<Recording> open_recording(const std::string& path, const RecordingOptions& options) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    if (is_rosbag2_folder(path)) return open_rosbag2(path, options);
    return Error{path, "is a directory", "name the recording inside it"};
  }
  const auto size = file_size_bytes(path);
  if (!size) return size.error();
  if (*size == 0) return Error{path, "is empty", ""};

  const std::string head = raw_head(path);
  if (head.empty()) return Error{path, "cannot be read", "check its permissions"};
  if (is_rosbag(head)) return open_rosbag1(path, options);
  if (head.starts_with(kMcapMagic)) return open_mcap(path, options);
  if (is_rosbag2_file(head)) return open_rosbag2(path, options);
  for (const Magic& magic : not_read())
    if (head.starts_with(magic.bytes)) return Error{path, magic.what, magic.remedy};
  if (head.starts_with("\x1F\x8B") && is_rosbag(unpacked_head(path)))
    return Error{path, "is a gzipped bag", "unpack it with `gunzip` first: a bag is read by byte offsets"};
  return open_text(path, options);
}

}  // namespace beaconless::io
