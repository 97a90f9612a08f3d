// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/describe.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

enum class Loss { huber, cauchy, tukey };

struct InnerConfig {
  double distance_m = 0.5;
  Loss loss = Loss::cauchy;
};

void describe(Fields& fields, InnerConfig& config) {
  fields("distance_m", config.distance_m, {0.01, 10.0}, "pairs further apart are no pairs");
  fields("loss", config.loss, {"huber", "cauchy", "tukey"}, "how outliers are weighed");
}

struct OuterConfig {
  int iterations = 30;
  bool deskew = false;
  std::string method = "icp-full";
  std::string name;
  InnerConfig icp;
};

void describe(Fields& fields, OuterConfig& config) {
  fields("iterations", config.iterations, {1, 1000}, "at most so many");
  fields("deskew", config.deskew, "whether the sweep is straightened");
  fields("method", config.method, Words{"icp-full", "walls"}, "which pipeline");
  fields("name", config.name, Words{}, "free text");
  fields.section("icp", config.icp);
}

TEST(Describe, ListsNamesInOrderWithTheirSections) {
  OuterConfig config;
  std::vector<std::string> names;
  for (const Field& field : fields_of(config)) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string>{"iterations", "deskew", "method", "name", "icp.distance_m",
                                             "icp.loss"}));
}

TEST(Describe, SetsEachKindOfValue) {
  OuterConfig config;
  const auto fields = fields_of(config);
  EXPECT_TRUE(set_field(fields, "iterations", "12"));
  EXPECT_TRUE(set_field(fields, "deskew", "true"));
  EXPECT_TRUE(set_field(fields, "method", "walls"));
  EXPECT_TRUE(set_field(fields, "name", "hall 3, night shift"));
  EXPECT_TRUE(set_field(fields, "icp.distance_m", "0.25"));
  EXPECT_TRUE(set_field(fields, "icp.loss", "tukey"));
  EXPECT_EQ(config.iterations, 12);
  EXPECT_TRUE(config.deskew);
  EXPECT_EQ(config.method, "walls");
  EXPECT_EQ(config.name, "hall 3, night shift");
  EXPECT_EQ(config.icp.distance_m, 0.25);
  EXPECT_EQ(config.icp.loss, Loss::tukey);
}

TEST(Describe, TextReadsBack) {
  OuterConfig config;
  config.icp.distance_m = 0.1 + 0.2;
  OuterConfig other;
  const auto fields = fields_of(config);
  for (const Field& field : fields)
    EXPECT_TRUE(set_field(fields_of(other), field.name, field.text())) << field.name;
  EXPECT_EQ(other.icp.distance_m, config.icp.distance_m);
}

TEST(Describe, BothEndsOfARangeBelongToIt) {
  OuterConfig config;
  const auto fields = fields_of(config);
  for (const char* value : {"0.01", "10"}) EXPECT_TRUE(set_field(fields, "icp.distance_m", value)) << value;
  for (const char* value : {"1", "1000"}) EXPECT_TRUE(set_field(fields, "iterations", value)) << value;
}

TEST(Describe, RefusedValuesChangeNothingAndSayWhatIsAllowed) {
  OuterConfig config;
  const auto fields = fields_of(config);
  const std::vector<std::pair<std::string, std::string>> bad{{"iterations", "0"},
                                                             {"iterations", "1001"},
                                                             {"iterations", "1.5"},
                                                             {"iterations", "many"},
                                                             {"deskew", "yes"},
                                                             {"method", "magic"},
                                                             {"method", ""},
                                                             {"icp.distance_m", "nan"},
                                                             {"icp.distance_m", "inf"},
                                                             {"icp.distance_m", "0.0099"},
                                                             {"icp.loss", "l2"},
                                                             {"icp.loss", "1"},
                                                             {"icp.distance_m", "0.5 m"},
                                                             {"icp.distance_m", ""}};
  for (const auto& [name, value] : bad) {
    const auto set = set_field(fields, name, value);
    ASSERT_FALSE(set) << name << " = " << value;
    EXPECT_EQ(set.error().where, name);
    EXPECT_NE(set.error().what.find('"' + value + '"'), std::string::npos) << set.error();
    EXPECT_NE(set.error().remedy.find("allowed: "), std::string::npos) << set.error();
  }
  const OuterConfig untouched;
  EXPECT_EQ(config.iterations, untouched.iterations);
  EXPECT_EQ(config.method, untouched.method);
  EXPECT_EQ(config.icp.distance_m, untouched.icp.distance_m);
  EXPECT_EQ(config.icp.loss, untouched.icp.loss);
}

TEST(Describe, AllowedIsWrittenForPeople) {
  OuterConfig config;
  const auto fields = fields_of(config);
  EXPECT_EQ(fields[0].allowed(), "1 … 1000");
  EXPECT_EQ(fields[1].allowed(), "false | true");
  EXPECT_EQ(fields[3].allowed(), "text");
  EXPECT_EQ(fields[4].allowed(), "0.01 … 10");
  EXPECT_EQ(fields[5].allowed(), "huber | cauchy | tukey");
}

TEST(Describe, AnUnknownNameGetsTheNearestKnownOne) {
  OuterConfig config;
  const auto set = set_field(fields_of(config), "icp.distance", "1");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().where, "icp.distance");
  EXPECT_EQ(set.error().remedy, "did you mean \"icp.distance_m\"?");
}

TEST(CheckConfig, TheDefaultsAreAllowed) { EXPECT_TRUE(check_config(OuterConfig{})); }

TEST(CheckConfig, NamesTheFieldThatIsNot) {
  const auto wrong_field = [](auto change) {
    OuterConfig config;
    change(config);
    const auto checked = check_config(config);
    return checked ? std::string() : checked.error().where;
  };
  EXPECT_EQ(wrong_field([](auto& c) { c.iterations = 0; }), "iterations");
  EXPECT_EQ(wrong_field([](auto& c) { c.method = "magic"; }), "method");
  EXPECT_EQ(wrong_field([](auto& c) { c.icp.distance_m = -1.0; }), "icp.distance_m");
  EXPECT_EQ(wrong_field([](auto& c) { c.icp.distance_m = std::numeric_limits<double>::quiet_NaN(); }),
            "icp.distance_m");
  EXPECT_EQ(wrong_field([](auto& c) { c.icp.loss = static_cast<Loss>(9); }), "icp.loss");
  EXPECT_EQ(wrong_field([](auto& c) { c.icp.loss = static_cast<Loss>(-1); }), "icp.loss");
}

}  // namespace
}  // namespace beaconless
