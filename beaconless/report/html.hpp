// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "beaconless/report/picture.hpp"

namespace beaconless::report {

/// How a verdict is to be taken; each has a colour and a sign of its own.
enum class Verdict { good, mixed, bad };

/// A number to be seen first: "Position RMSE", "0.7", "mm", "1.1 times the bound".
struct Card {
  std::string name;
  std::string value;
  std::string unit;
  std::string note;
};

/// Columns carry their units. The first column is left-aligned, the others are numbers.
struct Table {
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Builds a page that is one file: style and pictures inside, no scripts, nothing fetched, light and dark,
/// printable.
///
/// All text is escaped here. Order of the calls is the order on the page.
class Page {
 public:
  explicit Page(std::string title, std::string subtitle = "");

  void verdict(Verdict verdict, std::string_view words);
  void cards(const std::vector<Card>& cards);
  void heading(std::string_view words);

  /// A picture over the full width, its legend and its caption.
  void figure(const Picture& picture, std::string_view caption);
  /// What is between the two stands side by side where there is room.
  void begin_row();
  void end_row();

  void table(const Table& table);
  void list(const std::vector<std::string>& items);
  void paragraph(std::string_view words);
  /// Words that open onto text set as it is, at most about 200 kB of it.
  void details(std::string_view summary, std::string_view text, bool open = false);

  std::string html() const;

 private:
  std::string title_;
  std::string subtitle_;
  std::string body_;
};

}  // namespace beaconless::report
