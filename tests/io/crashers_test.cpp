// SPDX-License-Identifier: Apache-2.0
// The inputs below crashers/, a folder a reader, that broke a reader once or are made to; see tests/fuzz.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fuzz/readers.hpp"

namespace beaconless {
namespace {

namespace fs = std::filesystem;

using Reader = void (*)(fuzz::Bytes);

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> kReaders{
      {"carmen", fuzz::read_carmen},   {"echo", fuzz::read_echo},
      {"mcap", fuzz::read_mcap},       {"messages", fuzz::read_messages},
      {"picture", fuzz::read_picture}, {"rosbag1", fuzz::read_rosbag1},
      {"rosbag2", fuzz::read_rosbag2}, {"small_files", fuzz::read_small_files},
      {"zstd", fuzz::read_zstd}};
  return kReaders;
}

std::vector<fs::path> crashers() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(BEACONLESS_SOURCE_DIR "/tests/io/crashers"))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Crasher : public testing::TestWithParam<fs::path> {};

TEST_P(Crasher, EndsInEventsOrAnError) {
  std::ifstream in(GetParam(), std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  ASSERT_FALSE(bytes.empty());
  ASSERT_LE(bytes.size(), 4096U) << "minimise it";
  const auto reader = readers().find(GetParam().parent_path().filename().string());
  ASSERT_NE(reader, readers().end()) << "the folder is named like no reader";
  EXPECT_NO_THROW(reader->second({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}));
}

std::string name_of(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.parent_path().filename().string() + "_" + info.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Crasher, testing::ValuesIn(crashers()), name_of);

}  // namespace
}  // namespace beaconless
