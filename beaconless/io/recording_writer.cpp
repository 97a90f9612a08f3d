// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/recording_writer.hpp"

#include <string_view>
#include <utility>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/mcap_events.hpp"

namespace beaconless::io {
namespace {

constexpr const char* kNoRoom = "is there such a folder, and room in it?";

class CarmenRecording : public RecordingWriter {
 public:
  explicit CarmenRecording(std::string path) : path_(std::move(path)), log_(path_) {}

  void write(const Event& event) override {
    std::visit([this](const auto& e) { log_.write(e); }, event);
  }
  bool good() const override { return log_.good(); }
  Result<Done> finish() override {
    if (!log_.close()) return Error{path_, "cannot be written", kNoRoom};
    return Done{};
  }

 private:
  std::string path_;
  CarmenWriter log_;
};

class McapRecording : public RecordingWriter {
 public:
  McapRecording(const std::string& path, const RecordingWriterOptions& options)
      : scan_topic_(options.scan_topic.starts_with('/') ? options.scan_topic : "/scan"),
        file_(path, {.compression = options.compression}) {}

  void write(const Event& event) override {
    if (const auto* scan = std::get_if<Scan>(&event)) file_.write(*scan, scan_topic_);
    if (const auto* odometry = std::get_if<Odometry>(&event)) file_.write(*odometry);
    if (const auto* reference = std::get_if<ReferencePose>(&event)) file_.write(*reference);
  }
  bool good() const override { return file_.good(); }
  Result<Done> finish() override { return file_.finish(); }

 private:
  std::string scan_topic_;
  McapEventWriter file_;
};

bool is_carmen_name(std::string_view path) {
  if (path.ends_with(".gz")) path.remove_suffix(3);
  for (const char* end : {".log", ".clf", ".carmen"})
    if (path.ends_with(end)) return true;
  return false;
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> make_recording_writer(const std::string& path,
                                                               const RecordingWriterOptions& options) {
  std::unique_ptr<RecordingWriter> writer;
  if (path.ends_with(".mcap")) writer = std::make_unique<McapRecording>(path, options);
  if (is_carmen_name(path)) writer = std::make_unique<CarmenRecording>(path);
  if (!writer)
    return Error{path, "its name does not end like a format that can be written",
                 "written are .mcap (MCAP) and .log, .clf, .carmen (CARMEN), the last three also with .gz"};
  if (!writer->good()) return Error{path, "cannot be written", kNoRoom};
  return writer;
}

}  // namespace beaconless::io
