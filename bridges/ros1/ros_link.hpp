// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bridges/ros1/link.hpp"

// Plain C++17: what includes ROS is built as that. No type of ROS comes through here.
namespace beaconless::ros1 {

/// The link to ROS 1: topics, services, tf and parameters of a node.
///
/// A master that goes away is waited for; when one is back that does not know the node, everything is
/// subscribed and advertised again. Source: wiki.ros.org/ROS/Master_API, lookupNode.
class RosLink final : public Link {
 public:
  /// Takes ROS's own words (name:=value) from the command line. Waits for a master.
  RosLink(int& argc, char** argv, const std::string& name);
  ~RosLink() override;

  /// The node's private parameters as text, those of a tree joined by points: "walls.sigma_m".
  std::map<std::string, std::string> parameters() const;

  /// Subscribes, advertises, and hears until the node is shut down. Only inside it can be sent and asked.
  void run(const Handlers& handlers, const std::vector<std::string>& scan_topics);

  std::int64_t now_ns() override;
  double steady_s() override;
  TransformAnswer transform(const std::string& target, const std::string& source,
                            std::int64_t stamp_ns) override;
  void send_pose(const PoseMessage& pose) override;
  void send_transform(const TransformMessage& transform) override;
  void send_places(const PosesMessage& places) override;
  void send_path(const PosesMessage& path) override;
  void send_map(const GridMessage& map) override;
  void send_beams(const PointsMessage& beams) override;
  void send_diagnostic(const DiagnosticMessage& diagnostic) override;
  bool wants_beams() override;
  void log(Level level, const std::string& words) override;
  void keep_parameter(const std::string& name, double value) override;

 private:
  struct Wires;

  void look_after_master();

  Handlers handlers_;
  std::vector<std::string> scan_topics_;
  std::unique_ptr<Wires> wires_;
  bool is_master_away_ = false;
  GridMessage map_;  ///< sent; without cells: none was
};

}  // namespace beaconless::ros1
