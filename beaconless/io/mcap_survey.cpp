// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_survey.hpp"

#include <utility>

namespace beaconless::io {
namespace {

constexpr std::uint64_t kMaxDefinitionBytes = 16U << 20U;  // of a schema: the text of its message type
constexpr std::uint64_t kMaxSummaryBytes = std::uint64_t{256} << 20U;
constexpr std::uint64_t kMessageHeadBytes = 22;

class Surveyor {
 public:
  explicit Surveyor(const std::string& path) : path_(path), file_(path) {}

  Result<McapSurvey> run() {
    Bytes magic;
    if (!file_.read(0, kMcapMagic.size(), magic))
      return Error{path_, "is cut within its first " + std::to_string(kMcapMagic.size()) + " bytes", ""};
    if (std::string_view(reinterpret_cast<const char*>(magic.data()), magic.size()) != kMcapMagic)
      return Error{path_, "is not an MCAP file of version 0", ""};
    survey_.has_summary = read_summary();
    walk();
    if (!survey_.has_summary) count_all();
    return std::move(survey_);
  }

 private:
  using Bytes = McapFile::Bytes;

  void problem(std::uint64_t byte, std::string what) {
    survey_.problems.push_back({path_ + "@" + std::to_string(byte), std::move(what)});
  }

  template <class Parsed>
  static void keep(std::map<std::uint16_t, Parsed>& known, Parsed parsed) {
    known.emplace(parsed.id, std::move(parsed));  // the first one binds: the format wants all to be alike
  }

  /// Takes in what a record of the file, a chunk or the summary defines; false where it is damaged.
  bool define(McapOp op, std::span<const unsigned char> content) {
    if (op == McapOp::header) return parse(content, survey_.header);
    if (op == McapOp::schema) {
      McapSchema schema;
      if (content.size() > kMaxDefinitionBytes || !parse(content, schema)) return false;
      schema.text.clear();
      schema.text.shrink_to_fit();
      keep(survey_.schemas, std::move(schema));
    }
    if (op == McapOp::channel) {
      McapChannel channel;
      if (content.size() > kMaxDefinitionBytes || !parse(content, channel)) return false;
      keep(survey_.channels, std::move(channel));
    }
    return true;
  }

  /// Whether the file ends with a summary that is whole and tells how many messages each channel has.
  bool read_summary() {
    const std::uint64_t tail = kMcapFooterBytes + kMcapMagic.size();
    if (file_.size() < 2 * kMcapMagic.size() + kMcapFooterBytes) return false;
    const std::uint64_t footer_at = file_.size() - tail;
    const auto record = file_.record_at(footer_at);
    Bytes bytes;
    McapFooter footer;
    if (!record || record->op != McapOp::footer || !file_.read_content(*record, record->size, bytes) ||
        !parse(bytes, footer) || footer.summary_at == 0)
      return false;
    if (footer.summary_at > footer_at || footer_at - footer.summary_at > kMaxSummaryBytes ||
        !file_.read(footer.summary_at, footer_at + kMcapFooterCrcBytes - footer.summary_at, bytes))
      return problem(footer_at, "the footer points nowhere: the summary is not used"), false;
    if (footer.summary_crc != 0 && mcap_crc(bytes) != footer.summary_crc)
      return problem(footer.summary_at, "the summary's checksum does not match: it is not used"), false;
    bytes.resize(static_cast<std::size_t>(footer_at - footer.summary_at));
    if (take_summary(bytes)) return true;
    survey_ = {.problems = std::move(survey_.problems)};
    return false;
  }

  bool take_summary(std::span<const unsigned char> bytes) {
    bool has_statistics = false;
    McapStatistics statistics;
    const bool whole = for_each_mcap_record(bytes, [&](McapOp op, auto content, std::size_t) {
      if (op != McapOp::statistics) return define(op, content);
      has_statistics = parse(content, statistics);
      return has_statistics;
    });
    if (!whole || !has_statistics || statistics.channels != survey_.channels.size() ||
        statistics.schemas != survey_.schemas.size())
      return false;
    std::uint64_t total = 0;
    for (const auto& [channel, count] : statistics.channel_messages) {
      survey_.messages[channel] = count;
      total += count;
    }
    return total == statistics.messages;  // some writers leave the counts out
  }

  /// From record to record, up to the end of the data or of what is there of it.
  void walk() {
    Bytes bytes;
    std::uint64_t at = kMcapMagic.size();
    while (const auto record = file_.record_at(at)) {
      if (record->op == McapOp::data_end || record->op == McapOp::footer) {
        if (!survey_.has_summary)
          problem(at, "the file has no summary that tells all: it is unpacked to see what it holds");
        if (record->op == McapOp::data_end && file_.read_content(*record, sizeof(std::uint32_t), bytes)) {
          survey_.data_end_at = at;
          survey_.data_crc = McapReader(bytes).take<std::uint32_t>();
        }
        return;
      }
      at = record->end();
      if (record->op == McapOp::chunk) {
        walk_chunk(*record);
      } else if (record->op == McapOp::message) {
        walk_message(*record);
      } else if (record->op == McapOp::message_index) {
        note_channel(*record);
      } else if (record->op == McapOp::header || record->op == McapOp::schema ||
                 record->op == McapOp::channel) {
        if (!file_.read_content(*record, kMaxDefinitionBytes + 1, bytes) || !define(record->op, bytes))
          problem(record->at, "a record that defines what others mean is damaged; it is passed over");
      }
    }
    problem(at,
            "the file ends here without an end: it was cut, or its recorder did not close it; it is read "
            "up to here");
  }

  void walk_chunk(const McapRecord& record) {
    McapChunk chunk;
    std::uint64_t ignored = 0;
    file_.read_chunk(record, chunk, ignored);  // one that is damaged is told when it is unpacked
    survey_.parts.push_back({true, record.at, record.end(), chunk.start_ns, {}});
  }

  /// A message index follows its chunk.
  void note_channel(const McapRecord& record) {
    Bytes id;
    if (survey_.parts.empty() || !survey_.parts.back().is_chunk ||
        !file_.read_content(record, sizeof(std::uint16_t), id))
      return;
    survey_.parts.back().channels.insert(McapReader(id).take<std::uint16_t>());
  }

  void walk_message(const McapRecord& record) {
    if (!survey_.has_summary) count(record);
    auto& parts = survey_.parts;
    if (parts.empty() || parts.back().is_chunk)
      parts.push_back({false, record.at, record.end(), 0, {}});
    else
      parts.back().to = record.end();
  }

  void count(const McapRecord& record) {
    Bytes head;
    McapMessage message;
    if (file_.read_content(record, kMessageHeadBytes, head) && parse(head, message))
      ++survey_.messages[message.channel_id];
  }

  /// Unpacks every chunk to see what it defines and counts.
  void count_all() {
    Bytes records;
    for (McapPart& part : survey_.parts) {
      const auto record = part.is_chunk ? file_.record_at(part.from) : std::nullopt;
      if (!record || !file_.unpack(*record, records)) continue;  // told when the messages are read
      for_each_mcap_record(records, [&](McapOp op, auto content, std::size_t) {
        McapMessage message;
        if (op == McapOp::message && parse(content, message)) {
          ++survey_.messages[message.channel_id];
          part.channels.insert(message.channel_id);
        }
        define(op, content);
        return true;
      });
    }
  }

  std::string path_;
  McapFile file_;
  McapSurvey survey_;
};

}  // namespace

Result<McapSurvey> survey_mcap(const std::string& path) { return Surveyor(path).run(); }

}  // namespace beaconless::io
