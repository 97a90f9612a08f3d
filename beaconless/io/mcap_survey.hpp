// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/mcap_file.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// A stretch of an MCAP file that holds messages: one chunk, or records outside of chunks.
struct McapPart {
  bool is_chunk = false;
  std::uint64_t from = 0;
  std::uint64_t to = 0;
  std::uint64_t start_ns = 0;  ///< a chunk's first message by time
  std::set<std::uint16_t>
      channels;  ///< of a chunk's messages, as far as indexes or its contents told; empty: unknown
};

/// What a file holds, and where, without the messages themselves.
struct McapSurvey {
  McapHeader header;
  std::map<std::uint16_t, McapSchema> schemas;  ///< without their texts
  std::map<std::uint16_t, McapChannel> channels;
  std::map<std::uint16_t, std::uint64_t> messages;  ///< how many, by channel
  std::vector<McapPart> parts;                      ///< in the order of the file
  std::uint64_t data_end_at = 0;                    ///< 0: the file has no end of its data
  std::uint32_t data_crc = 0;                       ///< of all bytes before that; 0: not told
  bool has_summary = false;                         ///< one that is whole and tells all of this
  std::vector<Problem> problems;  ///< of the file as a whole: that it was cut, or not closed
};

/// Walks over the records of an MCAP file, and takes topics and counts from its summary.
///
/// A file that was cut is read as far as it goes, one without a summary or with a damaged one is unpacked
/// once to see what it holds; either is told as a Problem. Errors: not readable, not an MCAP file of version
/// 0. Cost: a seek a chunk (a message where there are no chunks); without a summary all chunks are unpacked.
Result<McapSurvey> survey_mcap(const std::string& path);

}  // namespace beaconless::io
