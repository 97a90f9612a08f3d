// SPDX-License-Identifier: Apache-2.0
// How the program takes its words: exit code 2 and a hint for wrong ones, results and work kept apart.
#include <fstream>

#include <gmock/gmock.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::Not;

using Usage = Program;
using Call = Drive;

TEST_F(Usage, WithoutWordsItSaysWhatThereIs) {
  const Ran ran = run({});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.out, "");
  for (const char* verb : {"localize", "evaluate", "simulate", "map", "poses", "convert", "info", "doctor",
                           "params", "demo", "Exit codes"})
    EXPECT_THAT(ran.err, HasSubstr(verb));
}

TEST_F(Usage, UnknownWordsAreNamedWithTheNearestKnownOne) {
  const std::vector<std::pair<Words, std::string>> calls{
      {{"localise"}, "localize"},
      {{"localize", "--mapp", "x"}, "--map"},
      {{"localize", "r", "--map", "m", "--start", "0,0,0", "--sgima", "1"}, "--sigma"},
      {{"map", "biuld"}, "build"},
      {{"params", "--markdwon"}, "--markdown"},
      {{"params", "--jsn"}, "--json"}};
  for (const auto& [words, meant] : calls) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 2) << words.back();
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("did you mean \"" + meant + "\"?"));
  }
  EXPECT_EQ(run({"xyzzy"}).exit_code, 2);
  EXPECT_EQ(run({"evaluate", "a", "b", "c"}).exit_code, 2);
}

TEST_F(Usage, MissingWordsAreWrong) {
  for (const Words& words : std::vector<Words>{{"localize"},
                                               {"localize", "r"},
                                               {"localize", "r", "--map"},
                                               {"evaluate", "a"},
                                               {"simulate", "small-static"},
                                               {"map"},
                                               {"map", "build", "r"},
                                               {"poses", "r"},
                                               {"convert", "r"},
                                               {"info"},
                                               {"doctor"},
                                               {"--json"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit_code, 2) << words.back();
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err, "");
  }
}

TEST_F(Usage, HelpAndVersionAreGood) {
  EXPECT_EQ(run({"--version"}).exit_code, 0);
  EXPECT_THAT(run({"--help"}).out, HasSubstr("localize"));
  for (const char* verb :
       {"localize", "evaluate", "simulate", "map", "poses", "convert", "info", "doctor", "params", "demo"})
    EXPECT_EQ(run({verb, "--help"}).exit_code, 0) << verb;
}

TEST_F(Call, WrongParametersGetAHint) {
  const std::string file = folder.write("c.yaml", "icp:\n  los: huber\n");
  const std::vector<std::pair<Words, std::string>> calls{
      {{"--set", "icp.los=huber"}, "icp.loss"},
      {{"--set", "icp.loss=hubre"}, "huber"},
      {{"--set", "icp.sigma_m=-1"}, "1e-04 … 1"},
      {{"--set", "icp.sigma_m=nan"}, "1e-04 … 1"},
      {{"--set", "icp.loss"}, "name=value"},
      {{"--config", file}, "icp.loss"},
      {{"--config", file}, file + ":2"},
      {{"--method", "icp-ful"}, "icp-full"},
      {{"--stamp-is", "never"}, "first"},
      {{"--base-from-laser", "1,2"}, "--base-from-laser"},
      {{"--base-from-laser", "1e3,0,0"}, "base_from_laser.x_m"}};
  for (const auto& [words, hint] : calls) {
    const Ran ran = run(Words{"localize", recording(), "--map", plan(), "--start", "3,1.4,0"} + words);
    EXPECT_EQ(ran.exit_code, 2) << words.back();
    EXPECT_THAT(ran.err, HasSubstr(hint)) << words.back();
    EXPECT_EQ(ran.out, "");
  }
}

TEST_F(Call, NumbersMustBeFinite) {
  for (const char* option : {"--sigma", "--min-range", "--max-range"})
    for (const char* value : {"nan", "inf", "-1", "x", ""})
      EXPECT_EQ(run(localize() + Words{option, value}).exit_code, 2) << option << " " << value;
  for (const char* value : {"0", "nan", "1e-9", "x"})
    EXPECT_EQ(run({"map", "build", recording(), "--poses", truth(), "--out", folder.path("m.yaml"),
                   "--resolution", value})
                  .exit_code,
              2)
        << value;
}

TEST_F(Call, JsonIsOneObjectAndNothingElse) {
  ASSERT_EQ(run(localize() + Words{"--out", folder.path("run")}).exit_code, 0);
  const std::string grid = folder.path("grid.yaml");
  const std::string log = folder.write("pose.log", "ODOM 1 2 0.5 0 0 0 1.0 robot 1.0\n");
  for (const Words& words : std::vector<Words>{
           {"simulate"},
           {"simulate", "small-static", "--out", folder.path("static")},
           localize(),
           {"evaluate", folder.path("run/trajectory.tum"), truth(), "--align", "--map", plan()},
           {"map", "build", recording(), "--poses", truth(), "--out", grid},
           {"poses", log, "--out", folder.path("poses.tum")},
           {"convert", recording(), folder.path("copy.mcap")},
           {"info", recording()},
           {"info", plan()},
           {"info", grid},
           {"doctor", recording()},
           {"doctor", plan()},
           {"params"},
           {"params", "--markdown"},
           {"demo", "--out", folder.path("demo")}}) {
    const Ran ran = run(words + Words{"--json"});
    EXPECT_EQ(ran.exit_code, 0) << words.front() << ran.err;
    EXPECT_TRUE(ran.json().is_object()) << words.front() << ran.out;
    const Ran before = run(Words{"--json"} + words);
    EXPECT_TRUE(before.json().is_object()) << words.front() << before.out;
  }
}

TEST_F(Call, JsonHoldsWhateverBytesAFileNameHas) {
  std::filesystem::copy_file(recording(), folder.path("dr\xffive.log.gz"));
  const Ran ran = run({"localize", folder.path("dr\xffive.log.gz"), "--map", plan(), "--base-from-laser",
                       "0.7,0,0", "--start-from", truth(), "--json", "--out", folder.path("r\xfeun")});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["scans"], kScans);
}

TEST_F(Call, QuietLeavesResultsOnly) {
  const Ran loud = run({"demo", "--out", folder.path("demo")});
  EXPECT_THAT(loud.err, HasSubstr("simulated robot"));
  EXPECT_THAT(loud.err, Not(HasSubstr("\r")));  // no progress bar where nobody looks
  const Ran quiet = run({"demo", "--out", folder.path("demo"), "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.err, "");
  EXPECT_THAT(quiet.out, HasSubstr("480 scans"));
}

TEST_F(Usage, ParamsListsEveryFieldWithItsDefault) {
  LocalizerConfig config;
  const auto fields = fields_of(config);
  const auto told = run({"params", "--json"}).json();
  ASSERT_EQ(told["parameters"].size(), fields.size());
  const std::string text = run({"params"}).out;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(told["parameters"][i], (nlohmann::json{{"name", fields[i].name},
                                                     {"default", fields[i].text()},
                                                     {"allowed", fields[i].allowed()},
                                                     {"sentence", fields[i].sentence}}));
    EXPECT_THAT(text, HasSubstr(fields[i].name));
  }
  EXPECT_EQ(told["methods"].size(), methods().size());
}

TEST_F(Usage, ReferenceOfTheParametersIsUpToDate) {
  std::ifstream in(BEACONLESS_SOURCE_DIR "/docs/reference/parameters.md", std::ios::binary);
  ASSERT_TRUE(in.good());
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string table = run({"params", "--markdown"}).out;
  EXPECT_THAT(table, HasSubstr("| `icp.sigma_m` |"));
  EXPECT_THAT(page, HasSubstr(table)) << "put the output of `beaconless params --markdown` there";
}

}  // namespace
}  // namespace beaconless
