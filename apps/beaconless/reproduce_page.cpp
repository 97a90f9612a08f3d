// SPDX-License-Identifier: Apache-2.0
// The page: the dissertation's chapter 4 in its own order.
#include <fmt/format.h>

#include "reproduce_figures.hpp"
#include "reproduce_tables.hpp"
#include "reproduction.hpp"

namespace beaconless::cli {
namespace {

constexpr double kWide_px = 800.0;

void put(report::Page& page, const Figure& figure) {
  page.paragraph(figure.caption);
  bool is_in_row = false;
  for (const Figure::Part& part : figure.parts) {
    const bool wants_row = part.picture.width_px < kWide_px;
    if (wants_row && !is_in_row) page.begin_row();
    if (!wants_row && is_in_row) page.end_row();
    is_in_row = wants_row;
    page.figure(part.picture, part.caption);
  }
  if (is_in_row) page.end_row();
}

/// The tables of a number, and why what is above the printed figures is so.
void put_table(report::Page& page, const Reproduction& r, std::string_view number) {
  for (const PublishedTable& table : kPublishedTables) {
    if (table.number != number) continue;
    page.table(published_table(table, r.comparisons));
    std::vector<std::string> reasons;
    for (const Comparison& comparison : r.comparisons) {
      if (comparison.table != &table) continue;
      for (const std::string& words : {why_above(comparison, r.tapes), caution(comparison)})
        if (!words.empty()) reasons.push_back(words);
    }
    page.list(reasons);
    page.table(other_maps_table(table, r.comparisons));
  }
}

void put_beginning(report::Page& page, const Reproduction& r) {
  page.paragraph(
      "Every scan here is simulated, in rooms whose dimensions were chosen for this project: the "
      "dissertation tells what stood in its rooms, but no lengths, poses, speeds or numbers of scans. A "
      "printed figure and a measured one beside it come from different rooms, so their order tells more than "
      "their difference. As in the dissertation the laser (1081 beams over 270°, 10 mm of noise) sits 0.7 m "
      "ahead of the base, and errors are those of the base. The start pose is the truth.");
  page.paragraph(fmt::format(
      "Three maps: the exact plan; the same as measured with a tape (each wall off by 8 mm and turned by "
      "0.2°, standard deviations, seed {}), which stands beside the printed figures because the dissertation "
      "measured its room so; and the exact plan drawn into cells of 5 cm, walls {:.1f} mm from the "
      "middle of their cells, as walls are on average. Methods run with their default parameters.",
      r.tape_seed, 50.0 * (0.5 - kGridPhase_cells)));
  const Score score = score_of(r.comparisons);
  const auto findings = findings_of(r);
  page.verdict(score.compared > 0 && score.at_or_below == score.compared ? report::Verdict::good
                                                                         : report::Verdict::mixed,
               findings.front());
  page.list({findings.begin() + 1, findings.end()});
  if (r.is_quick) page.paragraph("This is a quick run: only the first half second of each scenario.");
  std::string left_out;
  for (const std::string& method : r.methods.left_out) left_out += (left_out.empty() ? "" : ", ") + method;
  if (!left_out.empty()) page.paragraph("Left out of this run: " + left_out + ".");
}

void put_primitives(report::Page& page, const Reproduction& r, const std::vector<Figure>& scans) {
  page.heading("4.3 Primitive extraction");
  for (const Figure& figure : scans) put(page, figure);
  page.table(segmentation_times_table(r.times));
  page.paragraph(
      "In the dissertation the split alone takes nearly twice as long as with a segmentation before it. Its "
      "times are of Matlab, on a machine that it does not name.");
}

void put_overview(report::Page& page, const Reproduction& r) {
  page.heading("Constant offset and scatter");
  page.paragraph(
      "A mean and an SD of distances do not tell a method from a map: the printed full-scan ICP of Table 4.3 "
      "has a mean of 21.4 mm and an SD of 0.6 mm, nearly all of it one offset. Below, the mean error vector "
      "stands apart from what scatters about it. An offset that stays in the room is the map's, one that "
      "turns with the robot would be that of the laser's mounting.");
  page.table(offsets_table(r.experiments, r.methods.present));
  if (!r.tapes.empty()) {
    page.paragraph(
        "One tape is one draw. The same rooms measured again and again, eight scans on each, every one from "
        "its true pose:");
    page.table(tapes_table(r.tapes, r.comparisons));
  }
  page.heading("All methods in all scenarios");
  for (const MapKind map : kMapKinds) page.table(overview_matrix(map, r.experiments, r.methods.present));
  for (const MapKind map : kMapKinds) page.table(overview_table(map, r.experiments));
  page.heading("Times");
  page.table(update_times_table(r.experiments, r.methods.present));
}

}  // namespace

std::string html(const Reproduction& r) {
  report::Page page(
      "The experiments of the dissertation, again",
      "Chapter 4, Tables 4.2 to 4.9 and Figures 4.5 to 4.18: what it printed, what beaconless measures");
  const auto errors = error_figures(r.experiments);
  const auto paths = path_figures(r.scenes, r.experiments);
  const auto hectors = hector_figures(r.scenes, r.experiments);
  put_beginning(page, r);
  put_primitives(page, r, scan_figures(scene_named(r.scenes, "room-position-2"), r.scenes));
  page.heading("4.4.1 Small scenario with no movement");
  put(page, errors[0]);
  put(page, errors[1]);
  for (const char* number : {"4.3", "4.4"}) put_table(page, r, number);
  page.heading("4.4.2 Small scenario with rotation movement");
  put(page, errors[2]);
  put(page, errors[3]);
  put_table(page, r, "4.5");
  page.heading("4.4.3 Full room scenario");
  put(page, paths[0]);
  for (const char* number : {"4.6", "4.7", "4.8", "4.9"}) put_table(page, r, number);
  put(page, paths[1]);
  put(page, paths[2]);
  page.heading("4.5 Applying corner features to HectorSLAM");
  for (const Figure& figure : hectors) put(page, figure);
  for (const MapKind map : kMapKinds) page.table(drives_table(map, r.experiments, r.methods.present));
  put_overview(page, r);
  return page.html();
}

}  // namespace beaconless::cli
