// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_messages.hpp"

#include <algorithm>
#include <utility>

#include "beaconless/io/mcap_compression.hpp"

namespace beaconless::io {
namespace {

constexpr std::uint64_t kMessageHeadBytes = 22;

bool is_earlier(const McapPart& a, const McapPart& b) { return a.start_ns < b.start_ns; }

}  // namespace

McapMessages::McapMessages(const std::string& path, std::shared_ptr<const McapSurvey> survey,
                           std::set<std::uint16_t> channels, std::function<void(const Problem&)> on_problem)
    : path_(path),
      file_(path),
      survey_(std::move(survey)),
      channels_(std::move(channels)),
      on_problem_(std::move(on_problem)),
      parts_(survey_->parts) {
  if (std::all_of(parts_.begin(), parts_.end(), [](const McapPart& part) { return part.is_chunk; }))
    std::stable_sort(parts_.begin(), parts_.end(), is_earlier);
}

void McapMessages::skip(std::uint64_t byte, const std::string& what) {
  ++skipped_;
  if (on_problem_) on_problem_({path_ + "@" + std::to_string(byte), what + "; it is passed over"});
}

bool McapMessages::next(McapMessage& message) {
  for (;;) {
    if (next_of_stretch(message) || next_of_chunks(message)) return true;
    if (opened_ == parts_.size()) return check_data(), false;
    at_ = parts_[opened_].from;  // all chunks before this stretch are through
    ++opened_;
  }
}

bool McapMessages::next_of_stretch(McapMessage& message) {
  if (opened_ == 0 || parts_[opened_ - 1].is_chunk) return false;
  while (at_ < parts_[opened_ - 1].to) {
    const auto record = file_.record_at(at_);
    if (!record) break;
    at_ = record->end();
    if (record->op != McapOp::message) continue;
    if (!file_.read_content(*record, kMessageHeadBytes, bytes_) || !parse(bytes_, message)) {
      skip(record->at, "the message's record is damaged");
    } else if (record->size > kMaxMcapChunkBytes) {
      skip(record->at, "the message is larger than any that is read");
    } else if (channels_.contains(message.channel_id) && file_.read_content(*record, record->size, bytes_) &&
               parse(bytes_, message)) {
      return true;
    }
  }
  return false;
}

bool McapMessages::next_of_chunks(McapMessage& message) {
  for (;;) {
    std::erase_if(open_, [](const Open& open) { return open.is_done(); });
    const auto first = std::min_element(
        open_.begin(), open_.end(), [](const Open& a, const Open& b) { return a.next_ns() < b.next_ns(); });
    const bool is_chunk_next = opened_ < parts_.size() && parts_[opened_].is_chunk;
    if (is_chunk_next &&
        (open_.empty() || (open_.size() < kMostOpen && parts_[opened_].start_ns <= first->next_ns()))) {
      open_.push_back(unpacked(parts_[opened_++]));
      continue;
    }
    if (open_.empty()) return false;
    const auto at = static_cast<std::size_t>(first->entries[first->given++].second);
    McapReader in(std::span<const unsigned char>(first->records).subspan(at + 1));
    const auto size = in.take<std::uint64_t>();
    if (parse(in.bytes(size), message)) return true;
  }
}

/// Writers begin to count at the first byte, behind the magic or behind the header: the format leaves it
/// open.
void McapMessages::check_data() {
  constexpr std::uint64_t kBlock = 1U << 20U;
  if (std::exchange(is_data_checked_, true) || skipped_ > 0 || survey_->data_crc == 0 || !on_problem_) return;
  const auto header = file_.record_at(kMcapMagic.size());
  const std::uint64_t rest_at = std::min(header ? header->end() : 0, survey_->data_end_at);
  const std::uint64_t rest_size = survey_->data_end_at - rest_at;
  std::uint32_t rest = 0;
  for (std::uint64_t at = rest_at; at < survey_->data_end_at; at += bytes_.size()) {
    if (!file_.read(at, std::min(kBlock, survey_->data_end_at - at), bytes_)) return;
    rest = mcap_crc(bytes_, rest);
  }
  for (const std::uint64_t from : {std::uint64_t{0}, std::uint64_t{kMcapMagic.size()}, rest_at}) {
    if (!file_.read(from, rest_at - from, bytes_)) return;
    if (joined_mcap_crc(mcap_crc(bytes_), rest, rest_size) == survey_->data_crc) return;
  }
  on_problem_({path_ + "@" + std::to_string(survey_->data_end_at),
               "the checksum of the file's data does not match: some of what was read may be damaged"});
}

McapMessages::Open McapMessages::unpacked(const McapPart& part) {
  Open open;
  const auto record = file_.record_at(part.from);
  const auto done = record ? file_.unpack(*record, open.records) : Error{"", "the chunk is gone", ""};
  if (!done) {
    skip(part.from, done.error().what);
    return {};
  }
  const bool whole = for_each_mcap_record(open.records, [&](McapOp op, auto content, std::size_t at) {
    McapMessage message;
    if (op != McapOp::message) return true;
    if (!parse(content, message)) return false;
    if (channels_.contains(message.channel_id)) open.entries.emplace_back(message.log_ns, at);
    return true;
  });
  if (!whole) skip(part.from, "a record in the chunk is damaged, as are those behind it");
  const auto by_time = [](const McapIndexEntry& a, const McapIndexEntry& b) { return a.first < b.first; };
  std::stable_sort(open.entries.begin(), open.entries.end(), by_time);
  return open;
}

}  // namespace beaconless::io
