// SPDX-License-Identifier: Apache-2.0
#include "tables.hpp"

#include <fmt/format.h>

namespace beaconless::cli {
namespace {

std::string row(std::string_view name, const eval::Statistics& s) {
  return fmt::format("{:<17}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}\n", name, s.mean,
                     s.rmse, s.sd, s.max, s.min, s.median, s.p95);
}

}  // namespace

nlohmann::json to_json(const eval::Statistics& statistics) {
  const eval::Statistics& s = statistics;
  return {{"mean", s.mean}, {"rmse", s.rmse},     {"sd", s.sd},  {"max", s.max},
          {"min", s.min},   {"median", s.median}, {"p95", s.p95}};
}

Judgement judge(const Trajectory& estimate, const Trajectory& reference, const Map* map,
                const eval::RangeSensor& sensor, const Pose2& base_from_laser, double max_gap_s) {
  Judgement judgement{.evaluation = eval::evaluate(estimate, reference, max_gap_s)};
  const FloorPlan* plan = map != nullptr ? std::get_if<FloorPlan>(map) : nullptr;
  if (plan == nullptr) return judgement;
  judgement.bounds = eval::accuracy_bounds(RayCaster(plan->segments()), sensor, base_from_laser,
                                           judgement.evaluation.errors);
  judgement.crb_ratio = eval::crb_ratio(judgement.evaluation.errors, judgement.bounds);
  return judgement;
}

nlohmann::json to_json(const Judgement& judgement) {
  const eval::Evaluation& e = judgement.evaluation;
  nlohmann::json object = {
      {"pairs", e.errors.size()},
      {"unmatched", e.unmatched_count},
      {"position_m", to_json(e.raw.position_m)},
      {"heading_deg", to_json(e.raw.heading_deg)},
      {"aligned",
       {{"position_m", to_json(e.aligned.position_m)}, {"heading_deg", to_json(e.aligned.heading_deg)}}},
      {"crb_ratio", nullptr}};
  if (judgement.crb_ratio)
    object["crb_ratio"] = {{"position", judgement.crb_ratio->position},
                           {"heading", judgement.crb_ratio->heading}};
  return object;
}

std::string table_text(const eval::ErrorTable& table, std::string_view first, std::string_view second) {
  return fmt::format("{:<17}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "", "mean", "rmse", "sd", "max",
                     "min", "median", "p95") +
         row(first, table.position_m) + row(second, table.heading_deg);
}

}  // namespace beaconless::cli
