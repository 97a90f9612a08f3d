// SPDX-License-Identifier: Apache-2.0
// The same simulated scans out of every format, from files that the operating system still has in memory.
#include <filesystem>
#include <iostream>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/grid_io.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/rostopic_echo.hpp"

#include "bench/drives.hpp"
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "tests/io/rosbag1_writer.hpp"
#endif

namespace {

using namespace beaconless;

constexpr std::int64_t kNow_ns =
    1'700'000'000'000'000'000;  // a bag holds no stamp of zero, and text long ones

/// Files of this run, gone afterwards.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("beaconless-read_bench-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// A whole pass; MB/s are those of the file as it lies on the disk.
void read_recording(benchmark::State& state, const std::string& path, std::size_t scans_in_it) {
  std::size_t scans = 0;
  for (auto _ : state) {
    const auto recording = io::open_recording(path).value();
    for (const Event& event : recording) scans += std::holds_alternative<Scan>(event) ? 1 : 0;
  }
  if (scans != scans_in_it * static_cast<std::size_t>(state.iterations()))
    state.SkipWithError("not all scans were read");
  state.SetItemsProcessed(static_cast<std::int64_t>(scans));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

/// The gate alone, the copy of the raw scan that it takes included.
void make_scan(benchmark::State& state, const RawScan& raw) {
  for (auto _ : state) benchmark::DoNotOptimize(Scan::make(raw));
  state.SetItemsProcessed(state.iterations());
}

void read_grid(benchmark::State& state, const std::string& path, std::size_t bytes) {
  for (auto _ : state) benchmark::DoNotOptimize(io::read_map(path).value());
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

void write_carmen(const std::string& path, const std::vector<RawScan>& scans) {
  io::CarmenWriter log(path);
  for (const RawScan& scan : scans) log.write(scan);
  if (!log.close()) throw BadResult({.where = path, .what = "cannot be written"});
}

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
BagContent bag_of(const std::vector<RawScan>& scans) {
  BagContent content;
  for (const RawScan& scan : scans)
    content.scans.push_back({scan.stamp.ns, scan.frame_id, scan.angle_min_rad, scan.angle_increment_rad,
                             scan.time_increment_s, scan.scan_time_s, scan.range_min_m, scan.range_max_m,
                             scan.ranges_m, scan.intensities});
  return content;
}
#endif

void add_all(const Folder& folder) {
  const bench::Drive drive = bench::simulated_drive("small-drive");
  std::vector<RawScan> scans = drive.raw_scans;
  for (RawScan& scan : scans) scan.stamp.ns += kNow_ns;
  const auto add = [&](const char* name, const std::string& path) {
    benchmark::RegisterBenchmark(name, read_recording, path, scans.size())->Unit(benchmark::kMillisecond);
  };

  write_carmen(folder.file("drive.log"), scans);
  add("carmen", folder.file("drive.log"));
  write_carmen(folder.file("drive.log.gz"), scans);
  add("carmen_gz", folder.file("drive.log.gz"));
  io::write_rostopic_echo(folder.file("drive.txt"), scans).value();
  add("rostopic_echo", folder.file("drive.txt"));
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
  const BagContent bag = bag_of(scans);
  write_bag(folder.file("none.bag"), bag, BagCompression::none);
  add("rosbag1", folder.file("none.bag"));
  write_bag(folder.file("lz4.bag"), bag, BagCompression::lz4);
  add("rosbag1_lz4", folder.file("lz4.bag"));
  write_bag(folder.file("bz2.bag"), bag, BagCompression::bz2);
  add("rosbag1_bz2", folder.file("bz2.bag"));
#endif
  benchmark::RegisterBenchmark("make_scan", make_scan, scans.front())->Unit(benchmark::kMicrosecond);

  const OccupancyGrid grid = bench::grid_of(drive, 0.005);
  io::write_grid(folder.file("map.yaml"), grid).value();
  benchmark::RegisterBenchmark("read_map_pgm", read_grid, folder.file("map.yaml"),
                               std::filesystem::file_size(folder.file("map.pgm")))
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const Folder folder;
    add_all(folder);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "read_bench: " << error.what() << "\n";
    return 3;
  }
}
