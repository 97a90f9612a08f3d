// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_recording.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "beaconless/io/ros_events.hpp"
#include "beaconless/io/rosbag2_database.hpp"
#include "beaconless/io/told_laser.hpp"
#include "beaconless/io/topic_choice.hpp"
#include "beaconless/io/yaml_tree.hpp"
#include "beaconless/io/zstd_file.hpp"

namespace beaconless::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSqliteMagic("SQLite format 3\0", 16);

/// A file of the bag, unpacked where it had to be.
struct BagFile {
  std::string path;
  std::shared_ptr<const TemporaryFile> unpacked;
};

std::string head_of(const std::string& path) {
  std::string head(4096, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

Result<BagFile> unpacked(const std::string& path) {
  const std::string head = head_of(path);
  if (head.starts_with(kSqliteMagic)) return BagFile{path, nullptr};
  if (!head.starts_with(kZstdMagic))
    return Error{path, head.empty() ? "is missing, empty, or may not be read" : "is no SQLite database", ""};
  auto file = unpack_zstd_file(path);
  if (!file) return file.error();
  if (!head_of(file.value()->path()).starts_with(kSqliteMagic))
    return Error{path, "is compressed with zstd, but no SQLite database is in it", ""};
  const std::string plain = file.value()->path();
  return BagFile{plain, *std::move(file)};
}

bool is_bag_name(const std::string& name) { return name.ends_with(".db3") || name.ends_with(".db3.zstd"); }

/// bag_2 before bag_10, compressed or not.
bool comes_before(const std::string& a, const std::string& b) {
  const auto key = [](const std::string& name) {
    const std::string plain = name.substr(0, name.rfind(".db3"));
    return std::pair(plain.size(), plain);
  };
  return key(a) < key(b);
}

/// The files of a folder without metadata.yaml, as a recorder leaves it that did not end properly.
Result<std::vector<std::string>> files_found(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_bag_name(entry.path().string())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end(), comes_before);
  if (files.empty())
    return Error{folder, "is a directory without .db3 files", "name the recording inside it"};
  return files;
}

Result<std::vector<std::string>> files_of(const std::string& path) {
  std::error_code not_there;  // a name that is too long counts as one
  if (!fs::is_directory(path, not_there)) return std::vector<std::string>{path};
  const fs::path metadata = fs::path(path) / "metadata.yaml";
  if (!fs::exists(metadata, not_there)) return files_found(path);
  const auto yaml = read_yaml(metadata.string());
  if (!yaml) return yaml.error();
  const YamlNode* bag = yaml->find("rosbag2_bagfile_information");
  const YamlNode* storage = bag != nullptr ? bag->find("storage_identifier") : nullptr;
  if (storage != nullptr && storage->text != "sqlite3")
    return Error{where_in(metadata.string(), *storage), "the bag is stored as " + storage->described(),
                 "name the file inside the folder"};
  const YamlNode* listed = bag != nullptr ? bag->find("relative_file_paths") : nullptr;
  if (listed == nullptr || listed->kind != YamlNode::Kind::list || listed->items.empty())
    return Error{metadata.string(), "lists no files under rosbag2_bagfile_information: relative_file_paths",
                 "name the .db3 file itself"};
  std::vector<std::string> files;
  for (const YamlNode& item : listed->items) {
    const fs::path name = fs::path(item.text).filename();  // old recorders wrote the folder's name before it
    fs::path file = fs::path(path) / name;
    if (!fs::exists(file, not_there) && fs::exists(file.string() + ".zstd", not_there)) file += ".zstd";
    if (name.empty() || !fs::exists(file, not_there))
      return Error{where_in(metadata.string(), item), "the file " + item.described() + " is not there",
                   "copy the whole folder, or name one of its files"};
    files.push_back(file.string());
  }
  return files;
}

/// The messages of several files, one file after the other.
class BagMessages : public RosMessageSource {
 public:
  BagMessages(std::vector<BagFile> files, std::vector<std::string> topics)
      : files_(std::move(files)), topics_(std::move(topics)) {}

  Step next(RosMessage& message) override {
    for (;;) {
      if (current_) {
        const Step step = current_->next(message);
        if (step != Step::end) return step;
        tell(current_->ended_by());
      }
      if (next_ == files_.size()) return current_.reset(), Step::end;
      auto opened = Rosbag2Database::messages(files_[next_++].path, topics_);
      if (!opened) tell(to_string(opened.error()));
      current_ = opened ? std::move(opened).value() : nullptr;
    }
  }

  std::string ended_by() const override { return ended_by_; }

 private:
  void tell(const std::string& what) {
    if (!what.empty()) ended_by_ += (ended_by_.empty() ? "" : "; ") + what;
  }

  std::vector<BagFile> files_;
  std::vector<std::string> topics_;
  std::unique_ptr<RosMessageSource> current_;
  std::size_t next_ = 0;
  std::string ended_by_;
};

void add_counts(std::vector<Topic>& all, const std::vector<Topic>& more) {
  for (const Topic& topic : more) {
    const auto known = std::find_if(
        all.begin(), all.end(), [&](const Topic& t) { return t.name == topic.name && t.type == topic.type; });
    if (known == all.end())
      all.push_back(topic);
    else
      known->count += topic.count;
  }
}

}  // namespace

bool is_rosbag2_folder(const std::string& path) {
  std::error_code error;
  if (fs::exists(fs::path(path) / "metadata.yaml", error)) return true;
  for (const auto& entry : fs::directory_iterator(path, error))
    if (is_bag_name(entry.path().string())) return true;
  return false;
}

bool is_rosbag2_file(std::string_view head) {
  return head.starts_with(kSqliteMagic) ||
         (head.starts_with(kZstdMagic) &&
          unpacked_zstd_head(head, kSqliteMagic.size()).starts_with(kSqliteMagic));
}

Result<Recording> open_rosbag2(const std::string& path, const RecordingOptions& options) {
  const auto names = files_of(path);
  if (!names) return names.error();
  std::vector<BagFile> files;
  std::vector<Topic> topics;
  for (const std::string& name : *names) {
    auto file = unpacked(name);
    if (!file) return file.error();
    auto database = Rosbag2Database::open(file->path);
    auto found = database ? database.value().topics() : Result<std::vector<Topic>>(database.error());
    if (!found) return Error{name, found.error().what, found.error().remedy};
    add_counts(topics, *found);
    files.push_back(*std::move(file));
  }
  std::vector<Topic> scan_topics;
  std::vector<std::string> read_topics;
  for (const Topic& topic : topics) {
    if (is_laser_scan_type(topic.type)) scan_topics.push_back(topic);
    if (is_pose_type(topic.type)) read_topics.push_back(topic.name);
  }
  const auto chosen = choose_scan_topic(path, options, scan_topics);
  if (!chosen) return chosen.error();
  if (!chosen->empty()) read_topics.push_back(*chosen);
  const auto open_messages = [&](const std::vector<std::string>& of) {
    return std::make_unique<BagMessages>(files, of);
  };
  const ToldLaser laser = told_laser(open_messages, topics, *chosen);
  Recording recording(
      path, "ROS 2 bag (SQLite)", *chosen, std::move(topics),
      [path, files, read_topics, options, no_place = laser.problem]() -> std::unique_ptr<EventStream> {
        if (!no_place.empty() && options.on_problem) options.on_problem({path, no_place});
        return ros_events(path, std::make_unique<BagMessages>(files, read_topics), options);
      });
  if (laser.place) recording.set_laser_place(*laser.place);
  return recording;
}

}  // namespace beaconless::io
