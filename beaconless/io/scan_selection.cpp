// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/scan_selection.hpp"

#include "beaconless/core/parse.hpp"
#include "beaconless/io/text_table.hpp"

namespace beaconless::io {
namespace {

constexpr const char* kAllowed =
    "start:stop:step counted from 0, for example 1::2, 0:100 or 5; ^1::2 is all others";

}  // namespace

Result<ScanSelection> ScanSelection::parse(std::string_view text) {
  const Error wrong{"scans", "'" + shown(text) + "' is no selection of scans", kAllowed};
  if (text.find('-') != std::string_view::npos)
    return Error{"scans", "'" + shown(text) + "' counts from the end, which is not known while reading",
                 kAllowed};
  if (text.empty()) return ScanSelection{};

  ScanSelection selection;
  selection.is_left_out = text.front() == '^';
  std::uint64_t* const parts[] = {&selection.start, &selection.stop, &selection.step};
  std::size_t count = 0;
  for (std::string_view rest = text.substr(selection.is_left_out ? 1 : 0);; ++count) {
    if (count == 3) return wrong;
    const std::size_t colon = rest.find(':');
    const std::string_view part = rest.substr(0, colon);
    if (!part.empty()) {
      const auto number = parse_int<std::uint64_t>(part);
      if (!number) return wrong;
      *parts[count] = *number;
    }
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (selection.step == 0) return Error{"scans", "'" + shown(text) + "' has a step of 0", kAllowed};
  if (count == 0) {  // one number alone
    if (selection.start == std::numeric_limits<std::uint64_t>::max()) return wrong;
    selection.stop = selection.start + 1;
  }
  return selection;
}

}  // namespace beaconless::io
