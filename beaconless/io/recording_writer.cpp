// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/recording_writer.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "beaconless/io/atomic_file.hpp"
#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/mcap_sink.hpp"
#include "beaconless/io/ros_event_writer.hpp"
#include "beaconless/io/rosbag2_metadata.hpp"
#include "beaconless/io/rosbag2_writer.hpp"
#ifdef BEACONLESS_HAS_ROSBAG1
#include "beaconless/io/ros_schemas.hpp"
#include "beaconless/io/rosbag1_writer.hpp"
#endif

namespace beaconless::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoRoom = "is there such a folder, and room in it?";

enum class Kind { mcap, rosbag2_file, rosbag2_folder, rosbag1, carmen };

struct Format {
  Kind kind;
  const char* name;
  std::vector<std::string_view> ends;
  std::vector<std::string_view> compressions;  ///< the usual one first
};

const std::vector<Format>& formats() {
  static const std::vector<Format> kAll{
      {Kind::mcap, "an MCAP file", {".mcap"}, {"zstd", "lz4", "none"}},
      {Kind::rosbag2_file, "a ROS 2 bag", {".db3"}, {}},
      {Kind::rosbag2_folder, "a ROS 2 bag", {"/"}, {}},
      {Kind::rosbag1, "a ROS 1 bag", {".bag"}, {"lz4", "bz2", "none"}},
      {Kind::carmen, "a CARMEN log", {".log", ".clf", ".carmen", ".log.gz", ".clf.gz", ".carmen.gz"}, {}}};
  return kAll;
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return path.ends_with('/') || fs::is_directory(path, ignored);
}

const Format* format_of(const std::string& path) {
  for (const Format& format : formats()) {
    const auto fits = [&](std::string_view end) { return path.ends_with(end); };
    if (is_folder(path) ? format.kind == Kind::rosbag2_folder
                        : std::any_of(format.ends.begin(), format.ends.end(), fits))
      return &format;
  }
  return nullptr;
}

class CarmenRecording : public RecordingWriter {
 public:
  CarmenRecording(const std::string& path, const RecordingWriterOptions& options)
      : file_(path, path.ends_with(".gz") ? ".gz" : ""), log_(file_.part()) {
    if (options.laser_place) log_.place_laser(options.laser_place->base_from_laser);
  }

  void write(const Event& event) override {
    if (const auto* reference = std::get_if<ReferencePose>(&event); reference && reference->base_from_laser)
      log_.place_laser(*reference->base_from_laser);
    std::visit([this](const auto& e) { take(e); }, event);
  }
  bool good() const override { return log_.good(); }
  std::map<std::string, LeftOut> left_out() const override { return left_out_; }
  Result<Done> finish() override {
    if (!log_.close()) return Error{file_.path(), "cannot be written", kNoRoom};
    return file_.keep();
  }

 private:
  void take(const Scan& scan) { log_.write(scan); }
  void take(const Odometry& odometry) { take_first(odometry, odometry_, &LeftOut::odometry); }
  void take(const ReferencePose& pose) { take_first(pose, poses_, &LeftOut::poses); }

  /// What is of another source would read back as readings of this one.
  template <class Reading>
  void take_first(const Reading& reading, std::optional<std::string>& source, std::uint64_t LeftOut::*count) {
    if (!source) source = reading.source;
    if (*source == reading.source)
      log_.write(reading);
    else
      ++(left_out_[reading.source].*count);
  }

  PartFile file_;
  CarmenWriter log_;
  std::optional<std::string> odometry_;  ///< the source of it that is written
  std::optional<std::string> poses_;
  std::map<std::string, LeftOut> left_out_;
};

/// What all formats of ROS have in common.
class RosRecording : public RecordingWriter {
 public:
  RosRecording(std::unique_ptr<PartFile> file, std::unique_ptr<RosMessageSink> sink, RosEncoding encoding,
               const RecordingWriterOptions& options)
      : scan_topic_(options.scan_topic.starts_with('/') ? options.scan_topic : "/scan"),
        file_(std::move(file)),
        sink_(std::move(sink)),
        events_(*sink_, encoding),
        lasers_(options.lasers) {
    if (options.laser_place)
      events_.place_laser(options.laser_place->base_from_laser, options.laser_place->base_frame);
  }

  void write(const Event& event) override {
    if (const auto* scan = std::get_if<Scan>(&event)) put(*scan);
    if (const auto* odometry = std::get_if<Odometry>(&event)) events_.write(*odometry);
    if (const auto* reference = std::get_if<ReferencePose>(&event)) events_.write(*reference);
  }
  bool good() const override { return sink_->good(); }
  Result<Done> finish() override {
    if (const std::string why = sink_->finish(); !why.empty()) return Error{file_->path(), why, kNoRoom};
    if (auto done = complete(); !done) return done;
    return file_->keep();
  }

 protected:
  /// What is to be written when all messages are.
  virtual Result<Done> complete() { return Done{}; }

 private:
  void put(const Scan& scan) {
    const auto laser = lasers_.find(scan.frame_id());
    if (laser == lasers_.end()) return events_.write(scan, scan_topic_);
    if (const auto& place = laser->second.place)
      events_.place_laser(place->base_from_laser, place->base_frame);
    else
      events_.unplace_laser();
    events_.write(scan, laser->second.topic);
  }

  std::string scan_topic_;
  std::unique_ptr<PartFile> file_;
  std::unique_ptr<RosMessageSink> sink_;
  RosEventWriter events_;
  std::map<std::string, WrittenLaser> lasers_;
};

/// A bag of ROS 2 with the metadata beside its file.
class Rosbag2Folder : public RosRecording {
 public:
  /// `part` is the folder's, `bag` is the sink.
  Rosbag2Folder(std::string part, const Rosbag2Writer& bag, std::unique_ptr<PartFile> folder,
                std::unique_ptr<RosMessageSink> sink, std::string file_name,
                const RecordingWriterOptions& options)
      : RosRecording(std::move(folder), std::move(sink), RosEncoding::cdr, options),
        part_(std::move(part)),
        file_name_(std::move(file_name)),
        bag_(bag) {}

 private:
  Result<Done> complete() override {
    return write_file_atomically((fs::path(part_) / "metadata.yaml").string(),
                                 rosbag2_metadata(bag_, file_name_));
  }

  std::string part_;
  std::string file_name_;
  const Rosbag2Writer& bag_;
};

Result<std::unique_ptr<RecordingWriter>> make_folder(std::string path,
                                                     const RecordingWriterOptions& options) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_empty(path, error))
    return Error{path, "is there already and not empty", "give the copy another name"};
  if (fs::exists(path + ".part", error))
    return Error{path + ".part", "is in the way: a copy that was not finished?", "remove it"};
  auto folder = std::make_unique<PartFile>(path);
  if (!fs::create_directory(folder->part(), error)) return Error{path, "cannot be made", kNoRoom};
  const std::string name = fs::absolute(path).filename().string() + "_0.db3";
  auto bag = std::make_unique<Rosbag2Writer>((fs::path(folder->part()) / name).string());
  const std::string part = folder->part();
  const Rosbag2Writer& sink = *bag;
  return std::unique_ptr<RecordingWriter>(
      std::make_unique<Rosbag2Folder>(part, sink, std::move(folder), std::move(bag), name, options));
}

std::unique_ptr<RosMessageSink> mcap_sink(const std::string& path, const std::string& compression) {
  return std::make_unique<McapSink>(
      path, McapLayout{.compression = compression == "none"  ? McapCompression::none
                                      : compression == "lz4" ? McapCompression::lz4
                                                             : McapCompression::zstd});
}

/// Nothing in a build without ROS 1 bags.
std::unique_ptr<RosMessageSink> rosbag1_sink([[maybe_unused]] const std::string& path,
                                             [[maybe_unused]] const std::string& compression) {
#ifdef BEACONLESS_HAS_ROSBAG1
  const auto type_of = [](const std::string& type) {
    return Rosbag1Type{std::string(ros1_md5(type)), ros1_schema(type)};
  };
  const auto packed = compression == "none"  ? Rosbag1Compression::none
                      : compression == "bz2" ? Rosbag1Compression::bz2
                                             : Rosbag1Compression::lz4;
  return std::make_unique<Rosbag1Writer>(path, packed, type_of);
#else
  return nullptr;
#endif
}

}  // namespace

Result<Done> can_write_recording(const std::string& path, const RecordingWriterOptions& options) {
  const Format* format = format_of(path);
  if (format == nullptr)
    return Error{path, "its name does not end like a format that can be written",
                 "written are .mcap (MCAP), .db3 or for a folder / (ROS 2 bag), .bag (ROS 1 bag), and .log, "
                 ".clf, .carmen (CARMEN), the last three also with .gz"};
  if (format->kind == Kind::carmen && options.lasers.size() > 1)
    return Error{path, "a CARMEN log holds the scans of one laser here",
                 "convert each --topic into a log of its own"};
  const auto& known = format->compressions;
  if (options.compression.empty() ||
      std::find(known.begin(), known.end(), options.compression) != known.end())
    return Done{};
  std::string choice;
  for (const std::string_view one : known)
    choice.append(choice.empty() ? "choose one of: " : ", ").append(one);
  return Error{path, std::string(format->name) + " has no chunks packed as '" + options.compression + "'",
               known.empty() ? "leave the compression out" : choice};
}

Result<std::unique_ptr<RecordingWriter>> make_recording_writer(const std::string& path,
                                                               const RecordingWriterOptions& options) {
  if (auto possible = can_write_recording(path, options); !possible) return possible.error();
  const Kind kind = format_of(path)->kind;
  Result<std::unique_ptr<RecordingWriter>> writer = std::unique_ptr<RecordingWriter>();
  if (kind == Kind::rosbag2_folder) {
    writer = make_folder(path, options);
    if (!writer) return writer;
  } else if (kind == Kind::carmen) {
    writer.value() = std::make_unique<CarmenRecording>(path, options);
  } else {
    auto file = std::make_unique<PartFile>(path);
    auto sink = kind == Kind::mcap      ? mcap_sink(file->part(), options.compression)
                : kind == Kind::rosbag1 ? rosbag1_sink(file->part(), options.compression)
                                        : std::make_unique<Rosbag2Writer>(file->part());
    if (!sink)
      return Error{path, "is to be a ROS 1 bag, and this program was built without writing them",
                   "install librosbag-storage-dev and build again"};
    writer.value() =
        std::make_unique<RosRecording>(std::move(file), std::move(sink),
                                       kind == Kind::rosbag1 ? RosEncoding::ros1 : RosEncoding::cdr, options);
  }
  if (!writer.value()->good()) return Error{path, "cannot be written", kNoRoom};
  return writer;
}

}  // namespace beaconless::io
