// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include "beaconless/core/suggest.hpp"

#include "commands.hpp"

namespace beaconless::cli {
namespace {

/// The words that could stand in the call: the verbs until one is chosen, then that verb's, and the options.
std::vector<std::string> known_words(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) known.push_back(option->get_name());
  const auto chosen = app.get_subcommands();
  if (chosen.empty())
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(verb->get_name());
  for (const CLI::App* verb : chosen)
    for (const std::string& word : known_words(*verb)) known.push_back(word);
  return known;
}

/// Says what is wrong with the words of a call. A word that nothing knows comes first: what else is missing
/// is often missing because of it.
int refuse(const Console& console, const CLI::App& app, const CLI::ParseError& error) {
  const auto unknown = app.remaining(true);
  if (unknown.empty()) {
    app.exit(error);
    return exit_usage;
  }
  const std::string near = nearest_word(unknown.front(), known_words(app));
  return console.fail({unknown.front(), "there is no such verb or option",
                       near.empty() ? "run with --help for all of them" : "did you mean \"" + near + "\"?"},
                      exit_usage);
}

int run(int argc, char** argv) {
  Console console;
  int exit_code = exit_good;

  CLI::App app{"beaconless tells a mobile robot where it is, from its laser scanner and a map.",
               "beaconless"};
  app.set_version_flag("--version", "beaconless " BEACONLESS_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("-q,--quiet", console.quiet, "Print results and errors only");
  app.add_flag("--json", console.json, "Print the result as one JSON object");
  app.footer(
      "Exit codes: 0 good, 2 usage, 3 data, 4 localization lost or still ambiguous.\n"
      "Begin with:  beaconless demo --out out/demo");
  add_localize(app, console, exit_code);
  add_evaluate(app, console, exit_code);
  add_simulate(app, console, exit_code);
  add_map(app, console, exit_code);
  add_poses(app, console, exit_code);
  add_convert(app, console, exit_code);
  add_info(app, console, exit_code);
  add_doctor(app, console, exit_code);
  add_features(app, console, exit_code);
  add_methods(app, console, exit_code);
  add_params(app, console, exit_code);
  add_demo(app, console, exit_code);
  add_reproduce(app, console, exit_code);

  try {
    if (std::string_view(BEACONLESS_BUILD_TYPE) == "Debug")
      console.warn("this is a Debug build, many times slower than a Release build");
    if (argc < 2) std::cerr << app.help();
    if (argc < 2) return exit_usage;
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return refuse(console, app, error);
  } catch (const std::bad_alloc&) {
    return console.fail(
        {"beaconless", "there is not enough memory for this", "use a smaller map or recording"});
  } catch (const std::exception& error) {
    return console.fail(
        {"beaconless", error.what(), "this should not happen: please report it with the command"});
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return console.fail({"standard output", "cannot be written", "is there space?"});
  return exit_code;
}

}  // namespace
}  // namespace beaconless::cli

int main(int argc, char** argv) {
  try {
    return beaconless::cli::run(argc, argv);
  } catch (...) {  // not even the message could be made
    std::fputs("error: beaconless: there is not enough memory\n", stderr);
    return beaconless::cli::exit_data;
  }
}
