// SPDX-License-Identifier: Apache-2.0
#include "reproduce_experiments.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "beaconless/localize/make_localizer.hpp"

namespace beaconless::cli {
namespace {

constexpr std::array<std::string_view, 13> kMethods{
    "icp-full",    "icp-rdp",          "icp-corners",    "icp-corners-ft",  "icp-oc",
    "icp-falko",   "icp-flirt-blob",   "icp-flirt-edge", "icp-flirt-range", "icp-flirt-curvature",
    "hector-full", "hector-keypoints", "hector-regions"};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void judge(Experiment& experiment, const Trajectory& truth) {
  std::vector<eval::PosePair> pairs;
  pairs.reserve(experiment.estimates.size());
  for (std::size_t i = 0; i < experiment.estimates.size(); ++i)
    pairs.push_back({truth[i].stamp, experiment.estimates[i].map_from_base, truth[i].pose});
  experiment.errors = eval::errors_of(pairs);
  experiment.table = eval::table_of(experiment.errors);
  experiment.offset = offset_of(experiment.errors);
  for (std::size_t i = 0; i < experiment.estimates.size(); ++i) {
    const Status status = experiment.estimates[i].status;
    if (status == Status::ok) {
      ++experiment.ok_count;
      experiment.max_ok_m = std::max(experiment.max_ok_m, experiment.errors[i].position_m());
    } else {
      ++(status == Status::lost ? experiment.lost_count : experiment.degraded_count);
    }
  }
  if (!experiment.estimates.empty())
    experiment.closure_m =
        distance_m(experiment.estimates.front().map_from_base, experiment.estimates.back().map_from_base);
}

Experiment run_experiment(const Scene& scene, MapKind map, const std::string& method, Localizer& localizer,
                          Progress& progress) {
  using Clock = std::chrono::steady_clock;
  Experiment experiment{.scenario = scene.name(), .map = map, .method = method};
  localizer.start_at(scene.run.truth.front().pose);
  experiment.estimates.reserve(scene.run.events.size());
  std::vector<double> times_us;
  times_us.reserve(scene.run.events.size());
  for (const Event& event : scene.run.events) {
    const auto begin = Clock::now();
    experiment.estimates.push_back(localizer.update(event));
    times_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    progress.step();
  }
  experiment.median_us = percentile(times_us, 0.5);
  experiment.p99_us = percentile(times_us, 0.99);
  judge(experiment, scene.run.truth);
  return experiment;
}

}  // namespace

double Offset::norm_m() const { return std::hypot(x_m, y_m); }

Offset offset_of(std::span<const eval::PoseError> errors) {
  Offset offset;
  if (errors.empty()) return offset;
  const auto count = static_cast<double>(errors.size());
  for (const eval::PoseError& error : errors) {
    offset.x_m += error.x_m / count;
    offset.y_m += error.y_m / count;
    offset.along_m += error.along_m / count;
    offset.across_m += error.across_m / count;
    offset.heading_deg += degrees(error.heading_rad) / count;
  }
  double square_m2 = 0.0;
  double square_deg2 = 0.0;
  for (const eval::PoseError& error : errors) {
    square_m2 += std::pow(error.x_m - offset.x_m, 2) + std::pow(error.y_m - offset.y_m, 2);
    square_deg2 += std::pow(degrees(error.heading_rad) - offset.heading_deg, 2);
  }
  offset.scatter_m = std::sqrt(square_m2 / count);
  offset.scatter_deg = std::sqrt(square_deg2 / count);
  return offset;
}

Result<MethodList> reproduced_methods(std::span<const std::string> asked_for) {
  for (const std::string& name : asked_for) {
    const auto made = make_localizer({.method = name}, FloorPlan{});
    if (!made && made.error().where == "method") return made.error();
  }
  MethodList list;
  const auto is_wanted = [&](std::string_view name) {
    return asked_for.empty() || std::ranges::find(asked_for, name) != asked_for.end();
  };
  const auto is_known = [](std::string_view name) {
    return std::ranges::any_of(methods(), [&](const Method& method) { return method.name == name; });
  };
  for (const std::string_view name : kMethods)
    (is_known(name) && is_wanted(name) ? list.present : list.left_out).emplace_back(name);
  for (const Method& method : methods())
    if (std::ranges::find(kMethods, method.name) == kMethods.end() && is_wanted(method.name))
      list.present.push_back(method.name);
  return list;
}

std::vector<Experiment> run_experiments(const Console& console, std::span<const Scene> scenes,
                                        std::span<const std::string> methods) {
  std::size_t scans = 0;
  for (const Scene& scene : scenes) scans += scene.run.events.size();
  Progress progress(console, "scans localized", scans * kMapKinds.size() * methods.size());
  std::vector<Experiment> experiments(scenes.size() * kMapKinds.size() * methods.size());
  for (const auto& group : by_plan(scenes))
    for (std::size_t k = 0; k < kMapKinds.size(); ++k)
      for (std::size_t m = 0; m < methods.size(); ++m) {
        const Scene& first = scenes[group.front()];
        auto localizer =
            make_localizer({.method = methods[m], .base_from_laser = first.scenario.base_from_laser},
                           first.map(kMapKinds[k]));
        for (const std::size_t s : group)
          experiments[(s * kMapKinds.size() + k) * methods.size() + m] =
              localizer ? run_experiment(scenes[s], kMapKinds[k], methods[m], **localizer, progress)
                        : Experiment{.scenario = scenes[s].name(),
                                     .map = kMapKinds[k],
                                     .method = methods[m],
                                     .refused = localizer.error().what};
      }
  return experiments;
}

const Experiment* find(std::span<const Experiment> experiments, std::string_view scenario, MapKind map,
                       std::string_view method) {
  const auto found = std::ranges::find_if(experiments, [&](const Experiment& e) {
    return e.scenario == scenario && e.map == map && e.method == method && e.refused.empty();
  });
  return found == experiments.end() ? nullptr : &*found;
}

}  // namespace beaconless::cli
