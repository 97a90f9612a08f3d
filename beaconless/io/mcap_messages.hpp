// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "beaconless/io/mcap_file.hpp"
#include "beaconless/io/mcap_survey.hpp"

namespace beaconless::io {

/// One pass over the messages of an MCAP file, those of some channels.
///
/// Messages in chunks come in the order of their log times: a chunk's are sorted, and chunks that overlap in
/// time are read together, up to kMostOpen of them. Messages outside of chunks come in the order of the file,
/// as do all of a file that has both. Memory: the open chunks, unpacked.
class McapMessages {
 public:
  static constexpr std::size_t kMostOpen = 4;

  /// `on_problem` is told of chunks and records that are damaged; they are passed over. Where none is, the
  /// end of a pass holds all bytes against the checksum of the data section and tells when that does not
  /// match.
  McapMessages(const std::string& path, std::shared_ptr<const McapSurvey> survey,
               std::set<std::uint16_t> channels, std::function<void(const Problem&)> on_problem);

  /// The next message; false at the end. Its data are good until the next call.
  bool next(McapMessage& message);

  std::uint64_t skipped() const { return skipped_; }

 private:
  /// An unpacked chunk, and where in it the wanted messages begin, by time.
  struct Open {
    McapFile::Bytes records;
    std::vector<McapIndexEntry> entries;
    std::size_t given = 0;
    bool is_done() const { return given == entries.size(); }
    std::uint64_t next_ns() const { return entries[given].first; }
  };

  bool next_of_chunks(McapMessage& message);
  bool next_of_stretch(McapMessage& message);
  Open unpacked(const McapPart& part);
  void skip(std::uint64_t byte, const std::string& what);
  void check_data();

  std::string path_;
  McapFile file_;
  std::shared_ptr<const McapSurvey> survey_;
  std::set<std::uint16_t> channels_;
  std::function<void(const Problem&)> on_problem_;
  std::vector<McapPart> parts_;  ///< in the order in which they are opened
  std::size_t opened_ = 0;
  std::vector<Open> open_;
  std::uint64_t at_ = 0;  ///< in the stretch outside of chunks that is being read
  McapFile::Bytes bytes_;
  std::uint64_t skipped_ = 0;
  bool is_data_checked_ = false;
};

}  // namespace beaconless::io
