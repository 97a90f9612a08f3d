// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/map/map.hpp"

#include "localize_run.hpp"
#include "replay.hpp"

namespace beaconless::cli {

/// What is told of a recording that was localized in windows.
struct WindowFiles {
  nlohmann::json summary;
  std::vector<std::string> lines;
  std::string csv;
};

/// A finished run of a localizer.
struct Run {
  LocalizerConfig config;
  std::shared_ptr<const Map> map;
  std::optional<Trajectory> reference = {};
  Scan first_scan;
  Replay replay = {};
  std::optional<WindowFiles> windows = {};  ///< then each estimate is that of a window
  std::vector<std::string> problems = {};
};

/// The folder of a run's files, made before the work that fills them; gone again where that left it empty.
class RunFolder {
 public:
  /// No path: no folder. Errors: it cannot be made.
  static Result<RunFolder> make(const std::string& path);

  RunFolder(RunFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  RunFolder& operator=(RunFolder&&) = delete;
  ~RunFolder();

 private:
  explicit RunFolder(std::string made) : path_(std::move(made)) {}

  std::string path_;  ///< empty where it was there before
};

/// Writes trajectory.tum, estimates.csv, config.yaml, summary.json, map.svg and report.html where the words
/// say, tells the result, and gives the exit code.
int finish_run(const Console& console, const LocalizeWords& words, const Run& run);

}  // namespace beaconless::cli
