// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/io/byte_writer.hpp"
#include "beaconless/io/mcap_writer.hpp"

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {

/// A sensor_msgs/LaserScan as ROS 1 serializes it.
inline std::string ros1_bytes(const RawScan& scan) {
  std::string bytes;
  io::ByteWriter out(bytes);
  out.put(std::uint32_t{0});  // seq
  out.put(static_cast<std::uint32_t>(scan.stamp.ns / 1'000'000'000));
  out.put(static_cast<std::uint32_t>(scan.stamp.ns % 1'000'000'000));
  out.text(scan.frame_id);
  for (const float value : {scan.angle_min_rad, 0.0F, scan.angle_increment_rad, scan.time_increment_s,
                            scan.scan_time_s, scan.range_min_m, scan.range_max_m})
    out.put(value);
  for (const auto* values : {&scan.ranges_m, &scan.intensities}) {
    out.put(static_cast<std::uint32_t>(values->size()));
    for (const float value : *values) out.put(value);
  }
  return bytes;
}

/// An MCAP file of ROS 1 scans, written with the stamps as log times.
inline void write_ros1_mcap(const std::string& path, const std::vector<RawScan>& scans,
                            const io::McapLayout& layout) {
  io::McapWriter file(path, "ros1", layout);
  const auto channel =
      file.add_channel("/scan", "ros1", {.name = "sensor_msgs/LaserScan", .encoding = "ros1msg"});
  for (const RawScan& scan : scans) {
    const auto ns = static_cast<std::uint64_t>(scan.stamp.ns);
    file.write(channel, ns, ns, ros1_bytes(scan));
  }
  EXPECT_TRUE(file.finish().ok());
}

/// Every way in which a file of ours can be laid out, with chunks of a few messages.
inline std::vector<io::McapLayout> every_layout() {
  std::vector<io::McapLayout> layouts;
  for (const bool has_summary : {true, false}) {
    layouts.push_back({io::McapCompression::none, 0, has_summary});
    for (const auto compression :
         {io::McapCompression::none, io::McapCompression::lz4, io::McapCompression::zstd})
      layouts.push_back({compression, 2000, has_summary});
  }
  return layouts;
}

inline std::string name_of(const io::McapLayout& layout) {
  return std::string(layout.chunk_bytes == 0 ? "unchunked" : "chunked ") +
         std::string(to_string(layout.compression)) + (layout.has_summary ? " indexed" : " unindexed");
}

inline std::vector<Scan> gated(const std::vector<RawScan>& raw) {
  std::vector<Scan> scans;
  for (const RawScan& scan : raw) scans.push_back(Scan::make(scan).value());
  return scans;
}

}  // namespace beaconless
