// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bridges/ros1/link.hpp"

namespace beaconless::ros1 {

/// A link to nobody: answers as it was told to, and keeps what was sent.
class FakeLink final : public Link {
 public:
  std::int64_t now = 0;
  double steady = 100.0;
  std::map<std::pair<std::string, std::string>, TransformAnswer> transforms;  ///< by target and source

  std::vector<PoseMessage> poses;
  std::vector<TransformMessage> sent_transforms;
  std::vector<PosesMessage> places;
  std::vector<PosesMessage> paths;
  std::vector<GridMessage> maps;
  std::vector<PointsMessage> beams;
  std::vector<DiagnosticMessage> diagnostics;
  std::vector<std::string> logs;
  std::map<std::string, double> kept;

  std::int64_t now_ns() override { return now; }
  double steady_s() override { return steady; }
  TransformAnswer transform(const std::string& target, const std::string& source, std::int64_t) override {
    const auto at = transforms.find({target, source});
    return at != transforms.end() ? at->second
                                  : TransformAnswer{TransformAnswer::Kind::unknown, {}, "nobody tells"};
  }
  void send_pose(const PoseMessage& pose) override { poses.push_back(pose); }
  void send_transform(const TransformMessage& transform) override { sent_transforms.push_back(transform); }
  void send_places(const PosesMessage& sent) override { places.push_back(sent); }
  void send_path(const PosesMessage& path) override { paths.push_back(path); }
  void send_beams(const PointsMessage& sent) override { beams.push_back(sent); }
  void send_diagnostic(const DiagnosticMessage& diagnostic) override { diagnostics.push_back(diagnostic); }
  void send_map(const GridMessage& map) override { maps.push_back(map); }
  bool wants_beams() override { return true; }
  void log(Level, const std::string& words) override { logs.push_back(words); }
  void keep_parameter(const std::string& name, double value) override { kept[name] = value; }

  /// The transform of a pose in the plane, known.
  static TransformAnswer known(double x_m, double y_m, double qz = 0.0, double qw = 1.0) {
    return {TransformAnswer::Kind::known, {x_m, y_m, 0.0, 0.0, 0.0, qz, qw}, ""};
  }
};

}  // namespace beaconless::ros1
