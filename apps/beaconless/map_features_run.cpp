// SPDX-License-Identifier: Apache-2.0
#include "map_features_run.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/whole_file.hpp"
#include "beaconless/match/feature_map.hpp"
#include "beaconless/report/feature_map_view.hpp"

#include "words.hpp"

namespace beaconless::cli {
namespace {

struct MapFeaturesWords {
  std::string map;
  std::vector<std::string> detectors{"corners"};
  std::string csv;
  std::string plot;
  std::vector<std::string> set;
};

/// The parameters, under the names that they have for `beaconless localize`.
struct MapFeaturesConfig {
  PointFeaturesConfig features;
  FeatureMapConfig feature_map;
};

void describe(Fields& fields, MapFeaturesConfig& config) {
  fields.section("features", config.features);
  fields.section("feature_map", config.feature_map);
}

Result<Done> check_outputs(const MapFeaturesWords& words) {
  std::error_code none;
  for (const std::string& out : {words.csv, words.plot})
    if (!out.empty() && (out == words.map || std::filesystem::equivalent(out, words.map, none)))
      return Error{out, "this file is read, and would be written over", "give another name"};
  if (!words.csv.empty() && words.csv == words.plot)
    return Error{words.csv, "--csv and --plot are the same file", "give two"};
  return Done{};
}

void add_rows(std::string& csv, std::string_view detector, const FeatureMap& map) {
  for (std::size_t i = 0; i < map.features.size(); ++i) {
    const PointFeature& f = map.features[i];
    const FeatureEvidence& e = map.evidence[i];
    fmt::format_to(std::back_inserter(csv), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.9g},{:.9g},{:.9g},{},{:.4f}\n",
                   detector, f.point.x(), f.point.y(), f.orientation_rad, f.opening_rad, f.covariance(0, 0),
                   f.covariance(0, 1), f.covariance(1, 1), e.found_views, e.share);
  }
}

nlohmann::json say(const Console& console, std::string_view detector, const FeatureMap& map) {
  std::vector<double> scatter_m;
  scatter_m.reserve(map.evidence.size());
  for (const FeatureEvidence& evidence : map.evidence) scatter_m.push_back(evidence.scatter_m);
  const auto middle = scatter_m.begin() + static_cast<std::ptrdiff_t>(scatter_m.size() / 2);
  std::nth_element(scatter_m.begin(), middle, scatter_m.end());
  console.say(fmt::format("{:<16} {:>9} {:>18.1f}", detector, map.features.size(), 1e3 * *middle));
  return {
      {"detector", std::string(detector)}, {"features", map.features.size()}, {"median_scatter_m", *middle}};
}

int run(const Console& console, const MapFeaturesWords& words) {
  // 1. What was asked for.
  MapFeaturesConfig config;
  if (auto set = set_parameters(fields_of(config), words.set); !set)
    return console.fail(set.error(), exit_usage);
  if (auto checked = check_config(config); !checked) return console.fail(checked.error(), exit_usage);
  if (auto outputs = check_outputs(words); !outputs) return console.fail(outputs.error(), exit_usage);
  std::vector<Detector> wanted;
  for (const std::string& name : words.detectors) {
    const auto detector = detector_named(name);
    if (!detector) return console.fail(detector.error(), exit_usage);
    wanted.push_back(*detector);
  }
  const auto map = io::read_map(words.map);
  if (!map) return console.fail(map.error());
  // 2. One map of features a detector.
  std::string csv = "detector,x_m,y_m,orientation_rad,opening_rad,xx_m2,xy_m2,yy_m2,found_views,share\n";
  std::vector<report::TitledPicture> pictures;
  nlohmann::json rows = nlohmann::json::array();
  console.say(fmt::format("{:<16} {:>9} {:>18}", "detector", "features", "median scatter mm"));
  for (const Detector detector : wanted) {
    const auto features = build_feature_map(*map, detector, config.features, config.feature_map);
    if (!features) return console.fail({words.map, features.error().what, features.error().remedy});
    rows.push_back(say(console, to_string(detector), *features));
    if (!words.csv.empty()) add_rows(csv, to_string(detector), *features);
    if (!words.plot.empty())
      pictures.push_back(
          {fmt::format("{}: {}", std::filesystem::path(words.map).filename().string(), to_string(detector)),
           report::draw_feature_map(*map, *features)});
  }
  console.result({{"map", words.map}, {"detectors", rows}});
  // 3. Write.
  if (!words.csv.empty())
    if (auto written = io::write_whole_file(words.csv, csv); !written) return console.fail(written.error());
  if (!words.plot.empty())
    if (auto written = io::write_whole_file(words.plot, report::svg_sheet(pictures)); !written)
      return console.fail(written.error());
  return exit_good;
}

}  // namespace

void add_map_features(CLI::App& map, Console& console, int& exit_code) {
  auto* command = map.add_subcommand("features", "Which corners and keypoints a map has, for a detector");
  auto words = std::make_shared<MapFeaturesWords>();
  command->add_option("map", words->map, "The map's YAML: a floor plan or a grid")->required();
  command->add_option("--detector", words->detectors, "Whose features, separated by commas")
      ->delimiter(',')
      ->default_str("corners");
  command->add_option("--csv", words->csv,
                      "Write them: detector,x_m,y_m,orientation_rad,opening_rad, covariance, evidence");
  command->add_option("--plot", words->plot, "Draw them over the map, as SVG");
  command
      ->add_option("--set", words->set,
                   "One parameter, name=value, as feature_map.views.step_m=0.2; may be repeated")
      ->allow_extra_args(false);
  command->footer("Example:  beaconless map features hall.yaml --detector corners,falko --plot hall.svg");
  command->callback([&console, &exit_code, words] { exit_code = run(console, *words); });
}

}  // namespace beaconless::cli
