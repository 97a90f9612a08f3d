// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "beaconless/core/rng.hpp"

#include "mcap_samples.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

long peak_memory_kb() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

/// What a file that lost its end gives must be the beginning of what it held.
void expect_beginning(const std::vector<Scan>& scans, const std::vector<Scan>& all) {
  ASSERT_LE(scans.size(), all.size());
  EXPECT_TRUE(std::equal(scans.begin(), scans.end(), all.begin()));
}

TEST(McapDamage, AFileThatWasCutGivesItsBeginning) {
  const TempFolder folder;
  const auto raw = sample_scans(12, 20);
  const auto all = gated(raw);
  for (const auto& layout : every_layout()) {
    SCOPED_TRACE(name_of(layout));
    write_ros1_mcap(folder.path("whole.mcap"), raw, layout);
    const std::string whole = folder.read("whole.mcap");
    std::size_t most = 0;
    for (const std::size_t size : cuts(whole.size())) {
      if (size < io::kMcapMagic.size()) continue;  // not to be told from any other file
      const Pass pass = pass_over(folder.write("cut.mcap", whole.substr(0, size)));
      ASSERT_FALSE(pass.error) << *pass.error;
      expect_beginning(pass.scans, all);
      EXPECT_GE(pass.scans.size(), most);
      most = pass.scans.size();
      EXPECT_FALSE(pass.problems.empty()) << "cut at " << size;
    }
    EXPECT_EQ(most, all.size());
  }
}

TEST(McapDamage, MutationsNeverCrashHangOrGrow) {
  const TempFolder folder;
  const auto raw = sample_scans(8, 20);
  Rng rng(7);
  const long before_kb = peak_memory_kb();
  const auto start = std::chrono::steady_clock::now();
  for (const auto& layout : every_layout()) {
    write_ros1_mcap(folder.path("whole.mcap"), raw, layout);
    const std::string whole = folder.read("whole.mcap");
    for (int round = 0; round < 300; ++round) {
      std::string bytes = whole;
      const int hits = 1 + static_cast<int>(rng.uniform(0.0, 6.0));
      for (int hit = 0; hit < hits; ++hit) {
        const auto at = 8 + static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(bytes.size() - 8)));
        bytes[at] = static_cast<char>(rng.uniform(0.0, 1.0) < 0.5 ? 0xFF : rng.uniform(0.0, 256.0));
      }
      const Pass pass = pass_over(folder.write("mutant.mcap", bytes));
      EXPECT_LE(pass.scans.size(), 4 * raw.size());
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 60.0);  // about 2 s; a hang would run into the time limit of the test
  EXPECT_LT(peak_memory_kb() - before_kb, 64 << 10);  // a few chunks of 2 kB, and what sanitizers keep
}

TEST(McapDamage, AWrongChecksumLosesOneChunkAndSaysSo) {
  const TempFolder folder;
  const auto raw = sample_scans(20, 50);
  write_ros1_mcap(folder.path("a.mcap"), raw, {io::McapCompression::none, 2000});
  std::string bytes = folder.read("a.mcap");
  const std::string range(reinterpret_cast<const char*>(&raw[0].ranges_m[10]), 4);
  ++bytes[bytes.find(range)];
  const Pass pass = pass_over(folder.write("b.mcap", bytes));
  EXPECT_LT(pass.scans.size(), 20U);
  EXPECT_GT(pass.scans.size(), 10U);
  ASSERT_EQ(pass.problems.size(), 1U);
  EXPECT_THAT(pass.problems[0].what, HasSubstr("checksum"));
}

TEST(McapDamage, DataThatDoNotMatchTheirChecksumAreTold) {
  const TempFolder folder;
  const auto raw = sample_scans(20, 50);
  for (const bool has_summary : {true, false}) {
    write_ros1_mcap(folder.path("a.mcap"), raw, {io::McapCompression::none, 0, has_summary});  // no chunks
    std::string bytes = folder.read("a.mcap");
    const std::size_t told = pass_over(folder.path("a.mcap")).problems.size();
    const std::string range(reinterpret_cast<const char*>(&raw[0].ranges_m[10]), 4);
    ++bytes[bytes.find(range)];
    const Pass pass = pass_over(folder.write("b.mcap", bytes));
    EXPECT_EQ(pass.scans.size(), raw.size());
    ASSERT_EQ(pass.problems.size(), told + 1);
    EXPECT_THAT(pass.problems.back().what, HasSubstr("checksum of the file's data"));
  }
}

TEST(McapDamage, ADataChecksumMayBeginBehindTheMagicOrTheHeader) {
  const TempFolder folder;
  std::string header;
  append(header, io::McapHeader{"ros1", "another"});
  std::string message;
  append(message, io::McapMessage{.channel_id = 1});
  const auto problems = [&](std::uint32_t crc) {
    std::string bytes = std::string(io::kMcapMagic) + header + message;
    io::append_data_end(bytes, crc);
    append(bytes, io::McapFooter{});
    return pass_over(folder.write("a.mcap", bytes + std::string(io::kMcapMagic)), {.scans_optional = true})
        .problems.size();
  };
  const std::size_t untold = problems(0);
  const std::string magic(io::kMcapMagic);
  for (const std::string& counted : {magic + header + message, header + message, message}) {
    EXPECT_EQ(problems(io::mcap_crc(counted)), untold);
    EXPECT_EQ(problems(io::mcap_crc(counted) + 1), untold + 1);
  }
}

TEST(McapDamage, ADamagedSummaryIsDoneWithout) {
  const TempFolder folder;
  const auto raw = sample_scans(20, 50);
  write_ros1_mcap(folder.path("a.mcap"), raw, {});
  std::string bytes = folder.read("a.mcap");
  ++bytes[bytes.size() - 60];
  const Pass pass = pass_over(folder.write("b.mcap", bytes));
  EXPECT_EQ(pass.scans, gated(raw));
  ASSERT_FALSE(pass.problems.empty());
  EXPECT_THAT(pass.problems[0].what, HasSubstr("summary's checksum"));
}

/// A file with one chunk that says of itself what it likes.
std::string with_chunk(const io::McapChunk& chunk, std::string_view packed) {
  std::string bytes(io::kMcapMagic);
  append(bytes, io::McapHeader{"ros1", ""});
  append(bytes, chunk, packed);
  return bytes;
}

TEST(McapDamage, AChunkThatPromisesTooMuchIsNotUnpacked) {
  const TempFolder folder;
  const auto said = [&](const io::McapChunk& chunk, std::string_view packed) {
    const Pass pass = pass_over(folder.write("a.mcap", with_chunk(chunk, packed)));
    std::string all;
    for (const auto& problem : pass.problems) all += problem.what + "\n";
    return all;
  };
  const std::string packed = io::pack_mcap_chunk(io::McapCompression::zstd, std::string(1000, '\0'));
  EXPECT_THAT(said({.unpacked_size = 1ULL << 60U, .compression = "zstd"}, packed), HasSubstr("promises"));
  constexpr std::size_t kMuch = 64U << 20U;
  const std::string bomb = io::pack_mcap_chunk(io::McapCompression::zstd, std::string(kMuch, '\0'));
  EXPECT_THAT(said({.unpacked_size = kMuch, .compression = "zstd"}, bomb), HasSubstr("1000 times its size"));
  EXPECT_THAT(said({.unpacked_size = 999, .compression = "zstd"}, packed), HasSubstr("does not unpack"));
  EXPECT_THAT(said({.unpacked_size = 1001, .compression = "zstd"}, packed), HasSubstr("does not unpack"));
  EXPECT_THAT(said({.unpacked_size = 1000, .compression = "lz4"}, packed), HasSubstr("does not unpack"));
  EXPECT_THAT(said({.unpacked_size = 1000, .compression = "snappy"}, packed), HasSubstr("'snappy'"));
  EXPECT_THAT(said({.unpacked_size = 5, .compression = ""}, packed), HasSubstr("another size"));
}

TEST(McapDamage, ClaimsCostNothing) {
  const std::string packed = io::pack_mcap_chunk(io::McapCompression::lz4, "few bytes");
  std::vector<unsigned char> out;
  const auto bytes = std::span(reinterpret_cast<const unsigned char*>(packed.data()), packed.size());
  EXPECT_FALSE(io::unpack_mcap_chunk("lz4", bytes, io::kMaxMcapChunkBytes, out).ok());
  EXPECT_LT(out.capacity(), 1U << 20U);
}

}  // namespace
}  // namespace beaconless
