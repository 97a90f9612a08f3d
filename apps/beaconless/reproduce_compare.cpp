// SPDX-License-Identifier: Apache-2.0
#include "reproduce_compare.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace beaconless::cli {
namespace {

constexpr double kPrintedDigits = 1e4;
constexpr double kNoticeableShare = 0.1;  // of scans that were not ok

/// What is constant in an experiment's errors of one kind, and what is not.
struct Parts {
  double constant = 0.0;
  double scatter = 0.0;

  double constant_share() const {
    const double all = constant * constant + scatter * scatter;
    return all > 0.0 ? constant * constant / all : 0.0;
  }
};

Parts parts_of(const Experiment& experiment, Quantity quantity) {
  const Offset& offset = experiment.offset;
  return quantity == Quantity::position ? Parts{offset.norm_m(), offset.scatter_m}
                                        : Parts{std::abs(offset.heading_deg), offset.scatter_deg};
}

std::string constant_words(const Comparison& comparison, const Parts& parts) {
  const Quantity quantity = comparison.table->quantity;
  std::string cause;
  if (const Experiment* exact = comparison.on(MapKind::exact)) {
    const double without_tape = parts_of(*exact, quantity).constant;
    cause =
        without_tape < 0.3 * parts.constant
            ? fmt::format(" that comes with the tape ({} on the exact plan)",
                          with_unit(without_tape, quantity))
            : fmt::format(", of which {} are there on the exact plan too", with_unit(without_tape, quantity));
  }
  return fmt::format(
      "{:.0f} % of the mean square is one constant offset of {}{}; what scatters about it is {} (printed SD "
      "{}).",
      100.0 * parts.constant_share(), with_unit(parts.constant, quantity), cause,
      with_unit(parts.scatter, quantity), with_unit(comparison.row->sd, quantity));
}

std::string on_the_exact_map(const Comparison& comparison) {
  if (comparison.on(MapKind::exact) == nullptr) return "";
  const Quantity quantity = comparison.table->quantity;
  return fmt::format(" On the exact plan the mean is {} and the RMSE {}.",
                     with_unit(comparison.value(MapKind::exact, Statistic::mean), quantity),
                     with_unit(comparison.value(MapKind::exact, Statistic::rmse), quantity));
}

std::string on_other_tapes(const Comparison& comparison, const TapeSpread* spread) {
  if (spread == nullptr) return "";
  const auto& means = spread->means(comparison.table->quantity);
  const double share = TapeSpread::share_up_to(means, comparison.row->mean);
  return fmt::format(
      " On {} other tapes of the same care the mean is {} in the median, and at or below the printed one on "
      "{:.0f} %.",
      means.size(), with_unit(TapeSpread::quantile(means, 0.5), comparison.table->quantity), 100.0 * share);
}

std::string row_name(const Comparison& comparison) {
  return fmt::format("Table {}, {} ({})", comparison.table->number, comparison.row->label,
                     comparison.row->method);
}

}  // namespace

std::string_view name_of(Statistic statistic) {
  constexpr std::array<std::string_view, 5> kNames{"mean", "RMSE", "SD", "max", "min"};
  return kNames[static_cast<std::size_t>(statistic)];
}

double value_of(const PublishedRow& row, Statistic statistic) {
  return std::array{row.mean, row.rmse, row.sd, row.max, row.min}[static_cast<std::size_t>(statistic)];
}

double value_of(const eval::Statistics& s, Statistic statistic) {
  return std::array{s.mean, s.rmse, s.sd, s.max, s.min}[static_cast<std::size_t>(statistic)];
}

double Comparison::value(MapKind map, Statistic statistic) const {
  const eval::ErrorTable& errors = on(map)->table;
  return value_of(table->quantity == Quantity::position ? errors.position_m : errors.heading_deg, statistic);
}

bool Comparison::is_at_or_below(MapKind map, Statistic statistic) const {
  return std::round(kPrintedDigits * value(map, statistic)) <=
         std::round(kPrintedDigits * value_of(*row, statistic));
}

bool Comparison::is_own(MapKind map) const {
  return static_cast<double>(on(map)->ok_count) >=
         (1.0 - kNoticeableShare) * static_cast<double>(on(map)->errors.size());
}

std::vector<Comparison> compare(std::span<const Experiment> experiments) {
  std::vector<Comparison> comparisons;
  for (const PublishedTable& table : kPublishedTables)
    for (const PublishedRow& row : table.rows) {
      Comparison& comparison = comparisons.emplace_back(Comparison{&table, &row});
      for (const MapKind map : kMapKinds)
        comparison.measured[static_cast<std::size_t>(map)] =
            find(experiments, table.scenario, map, row.method);
    }
  return comparisons;
}

std::string why_above(const Comparison& comparison, std::span<const TapeSpread> spreads) {
  const Experiment* experiment = comparison.on(MapKind::tape);
  if (experiment == nullptr || (comparison.is_at_or_below(MapKind::tape, Statistic::mean) &&
                                comparison.is_at_or_below(MapKind::tape, Statistic::rmse)))
    return "";
  const Quantity quantity = comparison.table->quantity;
  const Parts parts = parts_of(*experiment, quantity);
  const std::string head = fmt::format("{}: mean {} for {}, RMSE {} for {}. ", row_name(comparison),
                                       with_unit(comparison.value(MapKind::tape, Statistic::mean), quantity),
                                       with_unit(comparison.row->mean, quantity),
                                       with_unit(comparison.value(MapKind::tape, Statistic::rmse), quantity),
                                       with_unit(comparison.row->rmse, quantity));
  const std::string body =
      parts.constant_share() > 0.5
          ? constant_words(comparison, parts)
          : fmt::format("Most of it scatters: {} about an offset of {} (printed SD {}).",
                        with_unit(parts.scatter, quantity), with_unit(parts.constant, quantity),
                        with_unit(comparison.row->sd, quantity));
  return head + body + on_the_exact_map(comparison) +
         on_other_tapes(comparison, find(spreads, comparison.table->scenario, comparison.row->method));
}

std::string caution(const Comparison& comparison) {
  const Experiment* experiment = comparison.on(MapKind::tape);
  if (experiment == nullptr || comparison.is_own(MapKind::tape)) return "";
  return fmt::format(
      "{}: {} of {} scans were degraded and {} lost; there the pose is not the method's own: it goes on by "
      "the "
      "motion alone, which after a true start looks better than it is, or the whole scan stands in.",
      row_name(comparison), experiment->degraded_count, experiment->errors.size(), experiment->lost_count);
}

std::string with_unit(double value, Quantity quantity) {
  if (quantity == Quantity::heading) return fmt::format("{:.3f}°", value);
  return std::abs(value) < 1e-3 ? fmt::format("{:.2f} mm", 1e3 * value)
                                : fmt::format("{:.1f} mm", 1e3 * value);
}

}  // namespace beaconless::cli
