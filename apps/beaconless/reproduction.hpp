// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "reproduce_compare.hpp"
#include "reproduce_experiments.hpp"
#include "reproduce_scenes.hpp"
#include "reproduce_tapes.hpp"
#include "reproduce_times.hpp"

namespace beaconless::cli {

/// Everything that was measured for the dissertation's chapter 4.
struct Reproduction {
  int tape_seed = 1;
  bool is_quick = false;
  MethodList methods;
  std::vector<Scene> scenes;
  std::vector<Experiment> experiments;
  std::vector<Comparison> comparisons;  ///< point into experiments
  std::vector<TapeSpread> tapes;
  SegmentationTimes times;
};

/// How many printed means and RMSEs were compared on the tape-measured plan, and how many are not exceeded.
struct Score {
  std::size_t compared = 0;
  std::size_t at_or_below = 0;
  std::size_t not_own = 0;  ///< of those, by methods that found few of the poses themselves
};
Score score_of(std::span<const Comparison> comparisons);

/// The same of the means alone, on this tape and in the mean over the others.
struct LuckOfTheTape {
  std::size_t compared = 0;
  std::size_t at_or_below = 0;
  double elsewhere = 0.0;
  std::size_t tapes = 0;
};
LuckOfTheTape luck_of(const Reproduction& reproduction);

/// What beats what, in three sentences that follow from the numbers: against the printed figures, by method
/// on the exact plans, and among people.
std::vector<std::string> findings_of(const Reproduction& reproduction);

/// The page, one HTML file.
std::string html(const Reproduction& reproduction);

/// The findings and the tables of errors, as Markdown.
std::string markdown(const Reproduction& reproduction);

/// A file beside the page.
struct TextFile {
  std::string name;
  std::string text;
};
/// Every number as CSV: tables, overview, tapes; and times, which alone is not the same twice.
std::vector<TextFile> csv_files(const Reproduction& reproduction);

}  // namespace beaconless::cli
