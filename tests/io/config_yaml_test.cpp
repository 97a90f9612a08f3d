// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/config_yaml.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/yaml_tree.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {

enum class Color { red, green };

struct InnerConfig {
  double distance_m = 0.5;
  Color color = Color::green;
};

void describe(Fields& fields, InnerConfig& config) {
  fields("distance_m", config.distance_m, {0.01, 10.0}, "pairs further apart are no pairs");
  fields("color", config.color, {"red", "green"}, "of the pairs");
}

struct MiddleConfig {
  InnerConfig inner;
  int count = 3;
};

void describe(Fields& fields, MiddleConfig& config) {
  fields.section("inner", config.inner);
  fields("count", config.count, {0, 100}, "how many");
}

struct OuterConfig {
  bool quick = false;
  std::string name;
  MiddleConfig middle;
  InnerConfig other;
};

void describe(Fields& fields, OuterConfig& config) {
  fields("quick", config.quick, "whether it is");
  fields("name", config.name, Words{}, "free text");
  fields.section("middle", config.middle);
  fields.section("other", config.other);
}

namespace {

using testing::HasSubstr;

std::vector<std::string> texts(OuterConfig config) {
  std::vector<std::string> texts;
  for (const Field& field : fields_of(config)) texts.push_back(field.text());
  return texts;
}

TEST(ConfigYaml, ReadsNestedMapsAndDottedNames) {
  const TempFolder folder;
  for (const char* yaml :
       {"quick: true\nmiddle:\n  inner:\n    distance_m: 0.25\n    color: red\n  count: 7\n",
        "quick: true\nmiddle.inner.distance_m: 0.25\nmiddle.inner.color: red\nmiddle.count: 7\n",
        "{quick: true, middle: {count: 7, inner.color: red, inner: {distance_m: 0.25}}}"}) {
    OuterConfig config;
    const auto read = read_config(folder.write("a.yaml", yaml), fields_of(config));
    ASSERT_TRUE(read) << read.error();
    EXPECT_TRUE(config.quick);
    EXPECT_EQ(config.middle.inner.distance_m, 0.25);
    EXPECT_EQ(config.middle.inner.color, Color::red);
    EXPECT_EQ(config.middle.count, 7);
    EXPECT_EQ(config.other.distance_m, 0.5) << "what is not named keeps its value";
  }
}

TEST(ConfigYaml, AFileOfCommentsSetsNothing) {
  const TempFolder folder;
  for (const char* yaml : {"", "# nothing\n", "middle:\n  # count: 7\n"}) {
    OuterConfig config;
    EXPECT_TRUE(read_config(folder.write("a.yaml", yaml), fields_of(config))) << yaml;
    EXPECT_EQ(texts(config), texts({}));
  }
}

TEST(ConfigYaml, ErrorsNameLineKeyValueAndWhatIsAllowedAndChangeNothing) {
  const TempFolder folder;
  struct Case {
    std::string yaml;
    int line;
    std::string key, what, remedy;
  };
  const std::string good = "quick: true\nmiddle:\n  count: 7\n";
  const std::vector<Case> cases{
      {good + "  inner: {distance_m: 99}\n", 4, "middle.inner.distance_m", "\"99\"", "0.01 … 10"},
      {good + "  inner: {distance_m: far}\n", 4, "middle.inner.distance_m", "\"far\"", "0.01 … 10"},
      {good + "  inner: {distance_m: .nan}\n", 4, "middle.inner.distance_m", "\".nan\"", "0.01 … 10"},
      {good + "  inner: {color: blue}\n", 4, "middle.inner.color", "\"blue\"", "red | green"},
      {good + "  inner: {colour: red}\n", 4, "middle.inner.colour", "no such", "\"middle.inner.color\""},
      {good + "  inner: 5\n", 4, "middle.inner", "\"5\"", "section"},
      {good + "  count: 8\n", 4, "count", "twice", ""},
      {good + "middle.count: 8\n", 4, "middle.count", "twice", ""},
      {good + "name: [a, b]\n", 4, "name", "a list of 2", "text"},
      {good + "name:\n", 4, "name", "nothing", "text"},
      {good + "name: {a: b}\n", 4, "name", "a map", "text"},
      {"quick: yes\n", 1, "quick", "\"yes\"", "false | true"},
      {"- quick\n", 1, "", "a list of 1", "parameter: value"},
      {"qick: true\n", 1, "qick", "no such", "\"quick\""},
  };
  for (const Case& c : cases) {
    OuterConfig config;
    const std::string path = folder.write("a.yaml", c.yaml);
    const auto read = read_config(path, fields_of(config));
    ASSERT_FALSE(read) << c.yaml;
    EXPECT_EQ(read.error().where, path + ":" + std::to_string(c.line)) << read.error();
    EXPECT_THAT(read.error().what, HasSubstr(c.key)) << read.error();
    EXPECT_THAT(read.error().what, HasSubstr(c.what)) << read.error();
    EXPECT_THAT(read.error().remedy, HasSubstr(c.remedy)) << read.error();
    EXPECT_EQ(texts(config), texts({})) << c.yaml;
  }
}

TEST(ConfigYaml, TheDumpSaysRangeSentenceAndWhatWasChanged) {
  OuterConfig config;
  config.middle.inner.distance_m = 0.25;
  config.name = "hall: 3";
  OuterConfig defaults;
  EXPECT_EQ(config_yaml(fields_of(config), fields_of(defaults)),
            "quick: false  # false | true; whether it is\n"
            "name: \"hall: 3\"  # changed, default \"\"; text; free text\n"
            "middle:\n"
            "  inner:\n"
            "    distance_m: 0.25  # changed, default 0.5; 0.01 … 10; pairs further apart are no pairs\n"
            "    color: green  # red | green; of the pairs\n"
            "  count: 3  # 0 … 100; how many\n"
            "other:\n"
            "  distance_m: 0.5  # 0.01 … 10; pairs further apart are no pairs\n"
            "  color: green  # red | green; of the pairs\n");
}

TEST(ConfigYaml, TheDumpReadsBack) {
  const TempFolder folder;
  Rng rng(1);
  const std::vector<std::string> names{
      "",       "plain", "null", "~",     "true",   "0.5",   "-",     "a: b",    "# x",
      "\"q\"",  "\\n",   "a\nb", "tab\t", " lead ", "ü … €", "*star", "&anchor", "{",
      "[1, 2]", "- x",   "%",    "@",     "`",      "'",     "|",     ">",       "---",
      "-1e3",   "...",   "!tag", "? k",   "a#b",    "a #b",  "\x01",  "\x7F",    "Null"};
  for (const std::string& name : names) {
    OuterConfig config;
    config.name = name;
    config.quick = rng.uniform() < 0.5;
    config.middle.count = static_cast<int>(rng.bits() % 101);
    config.middle.inner.distance_m = rng.uniform(0.01, 10.0);
    config.other.color = Color::red;
    OuterConfig defaults;
    ASSERT_TRUE(write_config(folder.path("a.yaml"), fields_of(config), fields_of(defaults)));
    OuterConfig again;
    const auto read = read_config(folder.path("a.yaml"), fields_of(again));
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(texts(again), texts(config)) << name;
  }
}

TEST(ConfigYaml, SurvivesDamage) {
  const TempFolder folder;
  OuterConfig defaults;
  const std::string whole = config_yaml(fields_of(defaults), fields_of(defaults));
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    std::string changed = whole.substr(0, i % 3 == 0 ? rng.bits() % whole.size() : whole.size());
    for (int k = 0; k < i % 4 && !changed.empty(); ++k)
      changed[rng.bits() % changed.size()] = static_cast<char>(rng.bits());
    OuterConfig config;
    (void)read_config(folder.write("a.yaml", changed), fields_of(config));
    EXPECT_TRUE(check_config(config)) << changed;
  }
}

}  // namespace
}  // namespace beaconless::io
