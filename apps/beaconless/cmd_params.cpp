// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "beaconless/localize/make_localizer.hpp"

#include "commands.hpp"

namespace beaconless::cli {
namespace {

/// In a Markdown table a bar ends the cell.
std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

int params(const Console& console, bool markdown) {
  LocalizerConfig config;
  nlohmann::json list = nlohmann::json::array();
  if (markdown) console.say("| parameter | default | allowed | what it is for |\n|---|---|---|---|");
  for (const Field& field : fields_of(config)) {
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
  nlohmann::json names = nlohmann::json::array();
  for (const Method& method : methods())
    names.push_back({{"name", method.name}, {"sentence", method.sentence}});
  console.result({{"parameters", list}, {"methods", names}});
  return exit_good;
}

}  // namespace

void add_params(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("params", "List every parameter with its default, range and meaning");
  auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "As a Markdown table");
  command->callback([&console, &exit_code, markdown] { exit_code = params(console, *markdown); });
}

}  // namespace beaconless::cli
