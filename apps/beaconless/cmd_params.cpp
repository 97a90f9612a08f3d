// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "beaconless/features/detector.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "commands.hpp"
#include "slam_parameters.hpp"

namespace beaconless::cli {
namespace {

/// In a Markdown table a bar ends the cell.
std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

nlohmann::json list_of(const Console& console, const std::vector<Field>& fields, bool markdown) {
  nlohmann::json list = nlohmann::json::array();
  if (markdown) console.say("| parameter | default | allowed | what it is for |\n|---|---|---|---|");
  for (const Field& field : fields) {
    list.push_back({{"name", field.name},
                    {"default", field.text()},
                    {"allowed", field.allowed()},
                    {"sentence", field.sentence}});
    if (markdown)
      console.say(fmt::format("| `{}` | {} | {} | {} |", field.name, field.text(), in_table(field.allowed()),
                              field.sentence));
    else
      console.say(
          fmt::format("{:<32} {:<10} {}  [{}]", field.name, field.text(), field.sentence, field.allowed()));
  }
  return list;
}

template <class Named>
nlohmann::json names_of(const Named& all) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& of : all) names.push_back({{"name", of.name}, {"sentence", of.sentence}});
  return names;
}

int params(const Console& console, bool markdown, bool features, bool slam) {
  nlohmann::json result;
  if (slam) {
    SlamParameters parameters;
    result = {{"parameters", list_of(console, fields_of(parameters), markdown)}};
  } else if (features) {
    DetectorsConfig config;
    result = {{"parameters", list_of(console, fields_of(config), markdown)},
              {"detectors", names_of(detectors())}};
  } else {
    LocalizerConfig config;
    result = {{"parameters", list_of(console, fields_of(config), markdown)},
              {"methods", names_of(methods())}};
  }
  console.result(result);
  return exit_good;
}

int list_methods(const Console& console) {
  for (const Method& method : methods()) console.say(fmt::format("{:<20} {}", method.name, method.sentence));
  console.result({{"methods", names_of(methods())}});
  return exit_good;
}

}  // namespace

void add_methods(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("methods", "List the methods of `localize --method`");
  command->callback([&console, &exit_code] { exit_code = list_methods(console); });
}

void add_params(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("params", "List every parameter with its default, range and meaning");
  auto markdown = std::make_shared<bool>(false);
  auto features = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "As a Markdown table");
  auto slam = std::make_shared<bool>(false);
  command->add_flag("--features", *features,
                    "Those of the detectors (beaconless features), not of the localizers");
  command->add_flag("--slam", *slam, "Those of beaconless map build --slam")->excludes("--features");
  command->callback([&console, &exit_code, markdown, features, slam] {
    exit_code = params(console, *markdown, *features, *slam);
  });
}

}  // namespace beaconless::cli
