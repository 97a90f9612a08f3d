// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include "recording_samples.hpp"
#include "rosbag2_writer.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

/// A line of /proc/self/status, in KiB.
long status_kib(const std::string& name) {
  std::ifstream in("/proc/self/status");
  std::string word;
  while (in >> word)
    if (word == name + ":") return in >> word ? std::stol(word) : -1;
  return -1;
}

/// In a process of its own, whose memory goes with it.
void write_scans(const std::string& path, std::size_t count) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<Bag2Message> messages;
    for (const RawScan& scan : sample_scans(count, 1081))
      messages.push_back({scan.stamp.ns, "/scan", "sensor_msgs/msg/LaserScan", cdr_of(scan)});
    write_bag2(path, messages);
    _exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
}

/// By how much memory grew at its peak while a recording of so many scans was read.
long growth_kib(const std::string& path, std::size_t count) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak starts anew
  const long before = status_kib("VmHWM");
  std::size_t scans = 0;
  const auto recording = io::open_recording(path).value();
  for (const Event& event : recording) scans += std::get<Scan>(event).size() / 1081;
  EXPECT_EQ(scans, count);
  return status_kib("VmHWM") - before;
}

TEST(Rosbag2, MemoryDoesNotGrowWithTheFile) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what was freed";
#endif
  const TempFolder folder;
  write_scans(folder.path("short.db3"), 300);
  write_scans(folder.path("long.db3"), 3000);
  growth_kib(folder.path("short.db3"), 300);  // what is loaded once
  const long of_short = growth_kib(folder.path("short.db3"), 300);
  const long of_long = growth_kib(folder.path("long.db3"), 3000);
  RecordProperty("short_kib", std::to_string(of_short));
  RecordProperty("long_kib", std::to_string(of_long));
  EXPECT_LT(of_long, of_short + 4096) << "the long file has 24 MiB more";
}

}  // namespace
}  // namespace beaconless
