// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/relations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Reads a file and gathers its problems.
struct Read {
  std::vector<Problem> problems;
  Result<std::vector<PoseRelation>> relations;

  explicit Read(const std::string& path)
      : relations(read_relations(path, [this](const Problem& problem) { problems.push_back(problem); })) {}
};

TEST(Relations, ByStamp) {
  const TempFolder folder;
  const Read read(
      folder.write("a.relations",
                   "# t1 t2 x y z roll pitch yaw\n"
                   "1216.630413 1217.490267 0.407950 -0.016330 0.000000 0.000000 0.000000 -0.069620\r\n"
                   "\n1411657682.042859001\t2 1 2 3 0.1 0.2 4.0"));
  ASSERT_TRUE(read.relations) << read.relations.error();
  EXPECT_THAT(read.problems, IsEmpty());
  EXPECT_THAT(
      *read.relations,
      ElementsAre(PoseRelation{Stamp{1216630413000}, Stamp{1217490267000}, {0.40795, -0.01633, -0.06962}},
                  PoseRelation{Stamp{1411657682042859001}, Stamp{2000000000}, {1.0, 2.0, wrap_angle(4.0)}}));
}

TEST(Relations, ByNumberOfScan) {
  const TempFolder folder;
  const Read read(
      folder.write("a.scanindex", "# i j x y theta\n18 22 0.407950 -0.016330 -0.069620\n0 4790 1 2 3\n"));
  ASSERT_TRUE(read.relations) << read.relations.error();
  EXPECT_THAT(*read.relations,
              ElementsAre(PoseRelation{std::uint64_t{18}, std::uint64_t{22}, {0.40795, -0.01633, -0.06962}},
                          PoseRelation{std::uint64_t{0}, std::uint64_t{4790}, {1.0, 2.0, 3.0}}));
}

TEST(Relations, LinesThatAreNoneAreToldAndPassedOver) {
  const TempFolder folder;
  const Read read(folder.write("a.relations",
                               "FLASER 3\n"                // no relation of either kind
                               "1 2 1 0 0 0 0 0.5\n"       // the first one: stamps
                               "1 2 1 0 0.5\n"             // a line of the other kind
                               "1 x 1 0 0 0 0 0.5\n"       //
                               "1 2 1 nan 0 0 0 0.5\n"     //
                               "1 2 1 0 0 0 inf 0.5\n"     // dropped, but must be a number
                               "1 2 1e10 0 0 0 0 0.5\n"    //
                               "1 2 1 0 0 0 0 0.5 more\n"  //
                               "3 4 1 0 0 0 0 0.5\n"));
  ASSERT_TRUE(read.relations) << read.relations.error();
  EXPECT_EQ(read.relations->size(), 2U);
  ASSERT_EQ(read.problems.size(), 7U);
  EXPECT_THAT(read.problems[0].where, HasSubstr("a.relations:1"));
  EXPECT_THAT(read.problems[1].where, HasSubstr("a.relations:3"));
  EXPECT_THAT(read.problems[1].what, HasSubstr("5 words"));
  EXPECT_THAT(read.problems[6].where, HasSubstr("a.relations:8"));
}

TEST(Relations, ScansAreWholeNumbersFromZero) {
  const TempFolder folder;
  const Read read(
      folder.write("a.scanindex", "0 1 1 0 0\n-1 2 1 0 0\n1.5 2 1 0 0\n1 99999999999999999999 1 0 0\n"));
  ASSERT_TRUE(read.relations);
  EXPECT_EQ(read.relations->size(), 1U);
  EXPECT_EQ(read.problems.size(), 3U);
}

TEST(Relations, AFileWithoutAnyIsAnError) {
  const TempFolder folder;
  for (const char* text : {"", "# nothing\n", "1 2 3\n", "1 2 0 0 0 0 0 nan\n"}) {
    const Read read(folder.write("a.relations", text));
    ASSERT_FALSE(read.relations) << text;
    EXPECT_THAT(read.relations.error().where, HasSubstr("a.relations"));
    EXPECT_THAT(read.relations.error().remedy, HasSubstr("t1 t2"));
  }
  EXPECT_FALSE(read_relations(folder.path("missing")));
}

TEST(Relations, TheOfficialFilesOfFr079) {
  const std::string by_stamp = recorded("fr079/fr079.relations");
  const std::string by_scan = recorded("fr079/fr079.relations.scanindex");
  if (by_stamp.empty() || by_scan.empty())
    GTEST_SKIP() << "fr079 is not here; BEACONLESS_DATA names its folder";
  const Read stamps(by_stamp);
  const Read scans(by_scan);
  ASSERT_TRUE(stamps.relations && scans.relations);
  EXPECT_THAT(stamps.problems, IsEmpty());
  EXPECT_THAT(scans.problems, IsEmpty());
  EXPECT_EQ(stamps.relations->size(), 1685U);
  EXPECT_EQ(scans.relations->size(), 1638U);
}

}  // namespace
}  // namespace beaconless::io
