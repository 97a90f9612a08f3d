// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bridges/ros1/messages.hpp"

// Plain C++17, without a type of ROS.
namespace beaconless::ros1 {

/// What tf says when it is asked for a transform.
struct TransformAnswer {
  enum class Kind { known, not_yet, unknown };
  Kind kind = Kind::unknown;  ///< not_yet: the frames are known, but what was told ends before that stamp
  Transform transform;        ///< of points in the source frame into the target frame
  std::string why;            ///< it is not known, in words
};

/// What the node hears; each is called from one and the same thread.
struct Handlers {
  std::function<void(const ScanMessage&)> on_scan;
  std::function<void(const PoseMessage&)> on_initial_pose;
  std::function<void(const GridMessage&)> on_map;
  /// Of tf, told by another node: its name, and whether the transform is static.
  std::function<void(const TransformMessage&, const std::string&, bool)> on_transform_of_other;
  std::function<void()> on_new_master;  ///< whose tf begins anew
  std::function<Answer(const GridMessage&, const PoseMessage&)> on_set_map;
  std::function<Answer()> on_global_localization;
  std::function<Answer()> on_request_nomotion_update;
  std::function<Answer()> on_save_pose;
  std::function<void()> on_tick;  ///< every few milliseconds of real time
};

/// What the node says and asks. ROS stands behind one such link, tests behind another.
class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;

  virtual std::int64_t now_ns() = 0;  ///< ROS's time, simulated where /use_sim_time says so; 0: not known yet
  virtual double steady_s() = 0;      ///< real seconds that never run backwards

  /// At a stamp, or the latest one there is where that is 0.
  virtual TransformAnswer transform(const std::string& target, const std::string& source,
                                    std::int64_t stamp_ns) = 0;

  virtual void send_pose(const PoseMessage& pose) = 0;
  virtual void send_transform(const TransformMessage& transform) = 0;
  virtual void send_places(const PosesMessage& places) = 0;
  virtual void send_path(const PosesMessage& path) = 0;
  virtual void send_map(const GridMessage& map) = 0;  ///< one that came from a file; stays until the next
  virtual void send_beams(const PointsMessage& beams) = 0;
  virtual void send_diagnostic(const DiagnosticMessage& diagnostic) = 0;
  virtual bool wants_beams() = 0;  ///< whether anybody listens to them

  virtual void log(Level level, const std::string& words) = 0;

  /// Keeps a number as a parameter of the node, for the next one of its name.
  virtual void keep_parameter(const std::string& name, double value) = 0;
};

}  // namespace beaconless::ros1
