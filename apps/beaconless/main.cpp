// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <string_view>

#include "commands.hpp"

int main(int argc, char** argv) {
  using namespace beaconless::cli;
  Console console;
  int exit_code = kGood;

  CLI::App app{"beaconless tells a mobile robot where it is, from its laser scanner and a map.",
               "beaconless"};
  app.set_version_flag("--version", "beaconless " BEACONLESS_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("-q,--quiet", console.quiet, "Print results and errors only");
  app.add_flag("--json", console.json, "Print the result as one JSON object");
  app.footer(
      "Exit codes: 0 good, 2 usage, 3 data, 4 localization lost.\n"
      "Begin with:  beaconless demo --out out/demo");
  add_localize(app, console, exit_code);
  add_evaluate(app, console, exit_code);
  add_simulate(app, console, exit_code);
  add_map(app, console, exit_code);
  add_poses(app, console, exit_code);
  add_info(app, console, exit_code);
  add_doctor(app, console, exit_code);
  add_params(app, console, exit_code);
  add_demo(app, console, exit_code);

  try {
    if (std::string_view(BEACONLESS_BUILD_TYPE) == "Debug")
      console.warn("this is a Debug build, many times slower than a Release build");
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kGood : kUsage;
  } catch (const std::exception& error) {
    return console.fail(
        {"beaconless", error.what(), "this should not happen: please report it with the command"});
  }
  return exit_code;
}
