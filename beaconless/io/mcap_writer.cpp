// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_writer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace beaconless::io {
namespace {

constexpr std::size_t kMostIds = 65535;  // what 16 bits hold, without 0

}  // namespace

McapWriter::McapWriter(const std::string& path, std::string_view profile, const McapLayout& layout)
    : path_(path), layout_(layout), out_(path, std::ios::binary | std::ios::trunc), good_(out_.good()) {
  layout_.chunk_bytes = std::min(layout_.chunk_bytes, kMaxMcapChunkBytes / 2);
  std::string head(kMcapMagic);
  append(head, McapHeader{std::string(profile), "beaconless"});
  put(head);
}

void McapWriter::put(std::string_view bytes) {
  if (!good_) return;
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  good_ = out_.good();
  at_ += bytes.size();
  crc_ = mcap_crc(bytes, crc_);
}

std::uint16_t McapWriter::add_channel(std::string_view topic, std::string_view message_encoding,
                                      McapSchema schema) {
  if (channels_.size() >= kMostIds) throw std::length_error("an MCAP file has room for 65535 topics");
  auto known = std::find_if(schemas_.begin(), schemas_.end(), [&](const McapSchema& other) {
    return other.name == schema.name && other.encoding == schema.encoding && other.text == schema.text;
  });
  std::string defined;
  if (known == schemas_.end()) {
    schema.id = static_cast<std::uint16_t>(schemas_.size() + 1);
    append(defined, schema);
    known = schemas_.insert(schemas_.end(), std::move(schema));
  }
  const McapChannel channel{static_cast<std::uint16_t>(channels_.size() + 1), known->id, std::string(topic),
                            std::string(message_encoding)};
  append(defined, channel);
  channels_.push_back(channel);
  if (layout_.chunk_bytes == 0)
    put(defined);
  else
    records_ += defined;
  return channel.id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t log_ns, std::uint64_t publish_ns,
                       std::string_view data) {
  const auto sequence = static_cast<std::uint32_t>(++counts_[channel]);
  statistics_.start_ns = statistics_.messages == 0 ? log_ns : std::min(statistics_.start_ns, log_ns);
  statistics_.end_ns = std::max(statistics_.end_ns, log_ns);
  ++statistics_.messages;
  const McapMessage message{channel,
                            sequence,
                            log_ns,
                            publish_ns,
                            {reinterpret_cast<const unsigned char*>(data.data()), data.size()}};
  if (layout_.chunk_bytes == 0) {
    records_.clear();
    append(records_, message);
    return put(records_);
  }
  chunk_.start_ns = in_chunk_ == 0 ? log_ns : std::min(chunk_.start_ns, log_ns);
  chunk_.end_ns = std::max(chunk_.end_ns, log_ns);
  ++in_chunk_;
  McapMessageIndex& index = message_indexes_[channel];
  index.channel_id = channel;
  index.entries.emplace_back(log_ns, records_.size());
  append(records_, message);
  if (records_.size() >= layout_.chunk_bytes) close_chunk();
}

void McapWriter::close_chunk() {
  const std::string packed = pack_mcap_chunk(layout_.compression, records_);
  chunk_.unpacked_size = records_.size();
  chunk_.unpacked_crc = mcap_crc(records_);
  chunk_.compression = to_string(layout_.compression);
  chunk_.packed_size = packed.size();
  McapChunkIndex index{.chunk = chunk_, .chunk_at = at_};
  std::string record;
  append(record, chunk_, packed);
  put(record);
  index.chunk_length = record.size();
  for (const auto& [channel, messages] : message_indexes_) {
    if (!layout_.has_summary) break;
    record.clear();
    append(record, messages);
    index.message_index_at.emplace_back(channel, at_);
    index.message_index_length += record.size();
    put(record);
  }
  chunk_indexes_.push_back(std::move(index));
  message_indexes_.clear();
  records_.clear();
  chunk_ = {};
  in_chunk_ = 0;
}

void McapWriter::put_summary() {
  const std::uint64_t summary_at = at_;
  std::string summary;
  std::string offsets;
  const auto group = [&](McapOp op, const auto& all) {
    const std::size_t from = summary.size();
    for (const auto& one : all) append(summary, one);
    if (summary.size() > from) append_summary_offset(offsets, op, summary_at + from, summary.size() - from);
  };
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels_.size());
  statistics_.chunks = static_cast<std::uint32_t>(chunk_indexes_.size());
  statistics_.channel_messages.assign(counts_.begin(), counts_.end());
  group(McapOp::schema, schemas_);
  group(McapOp::channel, channels_);
  group(McapOp::statistics, std::vector{statistics_});
  group(McapOp::chunk_index, chunk_indexes_);
  McapFooter footer{summary_at, summary_at + summary.size(), 0};
  summary += offsets;
  std::string end;
  append(end, footer);
  footer.summary_crc = mcap_crc(std::string_view(end).substr(0, kMcapFooterCrcBytes), mcap_crc(summary));
  append(summary, footer);
  put(summary);
}

Result<Done> McapWriter::finish() {
  if (!finished_) {
    finished_ = true;
    if (layout_.chunk_bytes > 0 && !records_.empty()) close_chunk();
    std::string end;
    append_data_end(end, crc_);
    put(end);
    if (layout_.has_summary) {
      put_summary();
    } else {
      end.clear();
      append(end, McapFooter{});
      put(end);
    }
    put(kMcapMagic);
    out_.close();
    good_ = good_ && !out_.fail();
  }
  if (!good_) return Error{path_, "cannot be written", "is there such a folder, and room in it?"};
  return Done{};
}

}  // namespace beaconless::io
