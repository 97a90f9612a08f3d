// SPDX-License-Identifier: Apache-2.0
// `beaconless reproduce`: the printed numbers, what it writes, and that it writes the same twice.
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include <gmock/gmock.h>

#include "beaconless/core/parse.hpp"

#include "apps/beaconless/reproduce_published.hpp"
#include "tests/apps/program.hpp"
#include "tests/report/well_formed.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

TEST(Published, EveryRowIsOneDistribution) {
  for (const cli::PublishedTable& table : cli::kPublishedTables)
    for (const cli::PublishedRow& row : table.rows) {
      const auto what = [&] { return std::string(table.number) + " " + std::string(row.label); };
      // Four printed digits: each of the three is off by half of the last at most.
      EXPECT_NEAR(row.rmse, std::hypot(row.mean, row.sd), 1.5e-4) << what();
      EXPECT_LE(row.min, row.mean) << what();
      EXPECT_LE(row.mean, row.rmse) << what();
      EXPECT_LE(row.rmse, row.max) << what();
    }
}

TEST(Published, TablesAreThoseOfTheDissertation) {
  std::size_t rows = 0;
  for (const cli::PublishedTable& table : cli::kPublishedTables) {
    EXPECT_TRUE(std::filesystem::exists(std::string(BEACONLESS_SOURCE_DIR) + "/data/scenarios/" +
                                        std::string(table.scenario) + ".yaml"))
        << table.number;
    rows += table.rows.size();
  }
  EXPECT_EQ(rows, 36U);
  EXPECT_EQ(cli::kPublishedTables.front().rows[2].rmse, 0.0068);
  EXPECT_EQ(cli::kPublishedTables.back().rows[3].max, 0.9577);
  for (const cli::PublishedTimes& times : cli::kTable42)
    EXPECT_EQ(times.threshold_m == 0.0, times.seconds[0] > 0.04) << "alone it took nearly twice as long";
}

/// Quick runs with a method of each kind.
class Reproduce : public Program {
 protected:
  Ran reproduce(const std::string& out, const Words& more = {}) const {
    return run(Words{"reproduce", "--quick", "--methods", "icp-full,icp-corners,hector-regions", "--out",
                     folder.path(out)} +
               more);
  }
  static bool is_run(const std::string& method) {
    return method == "icp-full" || method == "icp-corners" || method == "hector-regions";
  }
  /// The rows of a CSV without commas inside its words, each by the names of its columns.
  std::vector<std::map<std::string, std::string>> rows_of(const std::string& name) const {
    std::istringstream in(folder.read(name));
    std::vector<std::map<std::string, std::string>> rows;
    std::string line;
    std::getline(in, line);
    const std::string head = line;
    const auto columns = split_words(head, ",");
    while (std::getline(in, line)) {
      std::istringstream words(line);
      auto& row = rows.emplace_back();
      std::string word;
      for (std::size_t i = 0; i < columns.size() && std::getline(words, word, ','); ++i)
        row[std::string(columns[i])] = word;
    }
    return rows;
  }
  /// A page without the tables that are not the same twice.
  static std::string without_times(std::string page) {
    constexpr std::string_view kBegin = "<div class=\"table\">";
    constexpr std::string_view kEnd = "</div>\n";
    for (std::size_t at = 0; (at = page.find("measured on this machine", at)) != std::string::npos;) {
      const std::size_t begin = page.rfind(kBegin, at);
      page.erase(begin, page.find(kEnd, at) + kEnd.size() - begin);
      at = begin;
    }
    return page;
  }
};

TEST_F(Reproduce, WritesOnePageWithEveryTableAndFigureAndTheNumbersBesideIt) {
  const Ran ran = reproduce("r", {"--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const std::string page = folder.read("r/report.html");
  EXPECT_EQ(report::xml_fault(page.substr(page.find("<body"), page.rfind("</html>") - page.find("<body"))),
            "");
  for (int table = 2; table <= 9; ++table)
    EXPECT_THAT(page, HasSubstr("Table 4." + std::to_string(table) + ":"));
  for (int figure = 5; figure <= 18; ++figure)
    EXPECT_THAT(page, HasSubstr("<p>Figure 4." + std::to_string(figure) + "."));
  EXPECT_THAT(page, HasSubstr("rooms whose dimensions were chosen for this project"));
  EXPECT_THAT(page, HasSubstr("21.4 → "));
  EXPECT_THAT(page, HasSubstr("Left out of this run: icp-rdp, icp-corners-ft"));
  for (const char* file : {"r/summary.md", "r/tapes.csv", "r/times.csv"})
    EXPECT_NE(folder.read(file), "") << file;

  const auto rows = rows_of("r/tables.csv");
  EXPECT_EQ(rows.size(), 36U * 5U);
  std::size_t compared = 0;
  std::size_t at_or_below = 0;
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("verdict") == "missing", !is_run(row.at("method"))) << row.at("method");
    if (!is_run(row.at("method"))) continue;
    const double printed = parse_double(row.at("printed")).value();
    const double measured = parse_double(row.at("tape")).value();
    EXPECT_EQ(row.at("verdict"), measured < printed + 0.5e-4 ? "at_or_below" : "above");
    if (row.at("statistic") != "mean" && row.at("statistic") != "RMSE") continue;
    ++compared;
    at_or_below += row.at("verdict") == "at_or_below" ? 1U : 0U;
  }
  EXPECT_EQ(ran.json()["compared"], compared);
  EXPECT_EQ(ran.json()["at_or_below"], at_or_below);

  const auto experiments = rows_of("r/overview.csv");
  EXPECT_EQ(experiments.size(), 7U * 3U * 3U) << "scenarios, maps, methods";
  for (const auto& row : experiments) {
    EXPECT_TRUE(is_run(row.at("method")));
    EXPECT_EQ(row.at("scans"), "20");
    const auto of = [&](const char* column) { return parse_double(row.at(column)).value(); };
    EXPECT_NEAR(of("rmse_m"), std::hypot(of("mean_m"), of("sd_m")), 1e-9);
    EXPECT_NEAR(of("rmse_m"), std::hypot(of("offset_x_m"), of("offset_y_m"), of("scatter_m")), 1e-9);
    EXPECT_NEAR(of("rmse_deg"), std::hypot(of("offset_deg"), of("scatter_deg")), 1e-9);
    EXPECT_EQ(of("ok") + of("degraded") + of("lost"), 20.0);
  }
}

TEST_F(Reproduce, MeasuresWhatLocalizeMeasures) {
  // The last of three scenarios that share a localizer.
  const std::string scenario = "room-ellipse-three-people";
  ASSERT_EQ(reproduce("r").exit_code, 0);
  ASSERT_EQ(run({"simulate", scenario, "--out", folder.path("sim")}).exit_code, 0);
  for (const auto& row : rows_of("r/overview.csv")) {
    if (row.at("map") != "exact" || row.at("scenario") != scenario) continue;
    const Ran localized =
        run({"localize", folder.path("sim/recording.log.gz"), "--map", folder.path("sim/plan.yaml"),
             "--base-from-laser", "0.7,0,0", "--start-from", folder.path("sim/truth.tum"), "--reference",
             folder.path("sim/truth.tum"), "--scans", "0:20", "--json", "--method", row.at("method")});
    const auto error = localized.json()["error"];
    EXPECT_NEAR(parse_double(row.at("mean_m")).value(), error["position_m"]["mean"], 1e-7);
    EXPECT_NEAR(parse_double(row.at("max_deg")).value(), error["heading_deg"]["max"], 1e-6);
  }
}

TEST_F(Reproduce, IsTheSameTwiceButForTimesAndAnotherTapeChangesItsOwnNumbersOnly) {
  ASSERT_EQ(reproduce("first").exit_code, 0);
  ASSERT_EQ(reproduce("second").exit_code, 0);
  for (const std::string file : {"summary.md", "tables.csv", "overview.csv", "tapes.csv"})
    EXPECT_EQ(folder.read("first/" + file), folder.read("second/" + file)) << file;
  const std::string page = folder.read("first/report.html");
  EXPECT_LT(without_times(page).size(), page.size());
  EXPECT_TRUE(without_times(page) == without_times(folder.read("second/report.html"))) << "report.html";

  ASSERT_EQ(reproduce("other", {"--tape-seed", "7"}).exit_code, 0);
  const auto ours = rows_of("first/overview.csv");
  const auto others = rows_of("other/overview.csv");
  ASSERT_EQ(ours.size(), others.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_EQ(ours[i] == others[i], ours[i].at("map") != "tape")
        << ours[i].at("scenario") << " " << ours[i].at("method");
}

TEST_F(Reproduce, RefusesWhatItCannotDo) {
  EXPECT_EQ(run({"reproduce", "--help"}).exit_code, 0);
  EXPECT_EQ(run({"reproduce", "--tapes", "-1"}).exit_code, 2);
  EXPECT_EQ(run({"reproduce", "--quick", "--out", "/dev/null/there"}).exit_code, 3);
  const Ran unknown = run({"reproduce", "--methods", "icp-full,hector-ful"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean \"hector-full\"?"));
}

}  // namespace
}  // namespace beaconless
