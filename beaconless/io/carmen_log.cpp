// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_log.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "beaconless/core/parse.hpp"
#include "beaconless/io/carmen_line.hpp"
#include "beaconless/io/failed_pass.hpp"
#include "beaconless/io/float_text.hpp"
#include "beaconless/io/line_reader.hpp"
#include "beaconless/io/stamp_order.hpp"
#include "beaconless/io/topic_choice.hpp"

namespace beaconless::io {
namespace {

/// Whether a line that the end of the file ended is whole: its last words are a host and the logger's stamp.
/// Else a log that was cut could end with a pose, or a stamp, that lost its last digits.
bool ends_as_logged(std::string_view line) {
  static constexpr std::string_view kBlank = " \t";
  const auto last_word = [&line] {
    line = line.substr(0, line.find_last_not_of(kBlank) + 1);
    const std::size_t before = line.find_last_of(kBlank) + 1;
    const std::string_view word = line.substr(before);
    line = line.substr(0, before);
    return word;
  };
  return parse_double(last_word()).has_value() && !parse_double(last_word()).has_value();
}

class CarmenStream : public EventStream {
 public:
  CarmenStream(LineReader lines, RecordingOptions options)
      : lines_(std::move(lines)), options_(std::move(options)) {}

  std::optional<Event> next() override {
    if (scan_after_pose_) return Event(*std::exchange(scan_after_pose_, std::nullopt));
    while (const auto line = lines_.next()) {
      if (lines_.is_cut() && !ends_as_logged(*line)) {
        skip(Error{"", "the text ends within the line", ""});
      } else if (auto event = read(*line)) {
        return event;
      }
    }
    order_.report_once(options_.on_problem);
    return std::nullopt;
  }

  std::uint64_t skipped() const override { return skipped_; }

 private:
  std::optional<Event> read(std::string_view line) {
    std::string_view rest = line;
    const std::string_view keyword = take_word(rest);
    if (keyword == options_.topic && !keyword.empty()) return read_scan(line);
    if (keyword == "ODOM") return event_of(parse_carmen_odometry(line));
    if (keyword == "TRUEPOS") return event_of(parse_carmen_true_pose(line));
    if (keyword == "PARAM") params_.take(line);
    return std::nullopt;
  }

  std::optional<Event> read_scan(std::string_view line) {
    auto parsed = parse_carmen_scan(line, params_);
    if (!parsed) return skip(parsed.error());
    CarmenScan& found = parsed.value();
    const Stamp stamp = found.raw.stamp;
    auto scan = Scan::make(std::move(found.raw), options_.gate);
    if (!scan) return skip(scan.error());
    order_.see(stamp, lines_.where());
    if (!found.map_from_base) return Event(std::move(scan).value());
    scan_after_pose_ = std::move(scan).value();
    ReferencePose pose{stamp, *found.map_from_base, std::nullopt, options_.topic};
    if (*found.map_from_laser != *found.map_from_base)
      pose.base_from_laser = found.map_from_base->inverse() * *found.map_from_laser;
    return Event(std::move(pose));
  }

  template <class T>
  std::optional<Event> event_of(const Result<T>& parsed) {
    return parsed ? std::optional<Event>(*parsed) : skip(parsed.error());
  }

  std::optional<Event> skip(const Error& error) {
    ++skipped_;
    if (options_.on_problem) options_.on_problem({lines_.where(), error.what + "; the line is passed over"});
    return std::nullopt;
  }

  LineReader lines_;
  RecordingOptions options_;
  CarmenParams params_;
  StampOrder order_;
  std::optional<Scan> scan_after_pose_;
  std::uint64_t skipped_ = 0;
};

const char* type_of(std::string_view keyword) {
  return is_carmen_scan(keyword) ? "scan" : keyword == "ODOM" ? "odometry" : "pose";
}

}  // namespace

bool is_carmen_keyword(std::string_view keyword) {
  constexpr std::array kOthers{"ODOM",  "TRUEPOS",          "PARAM",     "SYNC",     "NEFF",     "VERTEX2",
                               "EDGE2", "NMEAGGA",          "FRAME",     "NMEARMC",  "SCANMARK", "ODO_UPDATE",
                               "POS",   "REMISSION_VALUES", "SM_UPDATE", "GLOBALPOS"};
  return is_carmen_scan(keyword) || std::find(kOthers.begin(), kOthers.end(), keyword) != kOthers.end();
}

Result<Recording> open_carmen_log(const std::string& path, const RecordingOptions& options) {
  auto lines = LineReader::open(path);
  if (!lines) return lines.error();
  std::map<std::string, std::uint64_t, std::less<>> counts;
  CarmenParams params;
  while (auto rest = lines.value().next()) {
    const std::string_view line = *rest;
    const std::string_view keyword = take_word(*rest);
    if (keyword == "PARAM") params.take(line);
    if (!is_carmen_scan(keyword) && keyword != "ODOM" && keyword != "TRUEPOS") continue;
    if (const auto known = counts.find(keyword); known != counts.end())
      ++known->second;
    else
      counts.emplace(keyword, 1);
  }
  std::vector<Topic> topics;
  std::vector<Topic> scan_topics;
  for (const auto& [keyword, count] : counts) {
    topics.push_back({keyword, type_of(keyword), count});
    if (is_carmen_scan(keyword)) scan_topics.push_back(topics.back());
  }
  const auto chosen = choose_scan_topic(path, options, scan_topics);
  if (!chosen) return chosen.error();
  RecordingOptions pass = options;
  pass.topic = *chosen;
  Recording recording(path, "CARMEN log", *chosen, std::move(topics),
                      [path, pass]() -> std::unique_ptr<EventStream> {
                        auto opened = LineReader::open(path, pass.on_problem);
                        if (!opened) return failed_pass(opened.error(), pass.on_problem);
                        return std::make_unique<CarmenStream>(std::move(opened).value(), pass);
                      });
  if (params.base_from_laser && !chosen->empty())
    recording.set_laser_place({*params.base_from_laser, "PARAM beaconless_laser_base_from_laser", ""});
  return recording;
}

}  // namespace beaconless::io
