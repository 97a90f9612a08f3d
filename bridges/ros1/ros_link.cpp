// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/ros_link.hpp"

#include <chrono>
#include <clocale>
#include <cstdio>
#include <utility>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <nav_msgs/SetMap.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "bridges/ros1/ros_messages.hpp"

namespace beaconless::ros1 {
namespace {

constexpr std::uint32_t kScansWaiting = 200;  // five seconds of a fast scanner
constexpr double kTick_s = 0.005;
constexpr double kLookAfterMaster_s = 2.0;

using Parameters = std::map<std::string, std::string>;

void flatten(const std::string& name, XmlRpc::XmlRpcValue value, Parameters& into) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeStruct:
      for (auto& [inner, of] : value) {
        std::string full = name.empty() ? "" : name + ".";
        flatten(full.append(inner), of, into);
      }
      break;
    case XmlRpc::XmlRpcValue::TypeBoolean:
      into[name] = static_cast<bool>(value) ? "true" : "false";
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      into[name] = std::to_string(static_cast<int>(value));
      break;
    case XmlRpc::XmlRpcValue::TypeDouble: {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
      into[name] = text;
      break;
    }
    case XmlRpc::XmlRpcValue::TypeArray: {
      std::string words;
      for (int i = 0; i < value.size(); ++i) {  // NOLINT(modernize-loop-convert): begin() is that of a struct
        Parameters one;
        flatten("", value[i], one);
        words += (words.empty() ? "" : " ") + one[""];
      }
      into[name] = words;
      break;
    }
    case XmlRpc::XmlRpcValue::TypeString:
      into[name] = static_cast<std::string>(value);
      break;
    default:
      into[name] = value.toXml();
  }
}

// roscpp subscribes to the clock with its first master, for as long as the process lives; the next master has
// to be told of that subscription, and its publishers have to be handed on.
void hear_clock_again() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue publishers;
  request[0] = ros::this_node::getName();
  request[1] = "/clock";
  request[2] = "rosgraph_msgs/Clock";
  request[3] = ros::XMLRPCManager::instance()->getServerURI();
  if (!ros::master::execute("registerSubscriber", request, response, publishers, false)) return;
  // As the master itself would tell us of publishers.
  request[2] = publishers;
  const auto& manager = ros::XMLRPCManager::instance();
  auto* own = manager->getXMLRPCClient("127.0.0.1", static_cast<int>(manager->getServerPort()), "/");
  own->execute("publisherUpdate", request, response);
  manager->releaseXMLRPCClient(own);
}

// With the name of who tells it, which a listener of tf does not pass on.
ros::Subscriber hear_tf_of_others(ros::NodeHandle& node, const std::string& topic, bool is_static,
                                  const Handlers& on) {
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  const boost::function<void(const Event&)> hear = [&on, is_static](const Event& event) {
    if (event.getPublisherName() == ros::this_node::getName()) return;
    for (const auto& t : event.getConstMessage()->transforms)
      on.on_transform_of_other(plain(t), event.getPublisherName(), is_static);
  };
  return node.subscribe<tf2_msgs::TFMessage, const Event&>(topic, 100, hear);
}

// Services without words of their own say what went wrong by failing, and in the log.
bool told(const Answer& answer) {
  if (!answer.is_done) ROS_WARN("%s", answer.words.c_str());
  return answer.is_done;
}

}  // namespace

/// All that hangs on one master.
struct RosLink::Wires {
  Wires(const Handlers& on, const std::vector<std::string>& scan_topics, const GridMessage& sent_map)
      : listener(buffer) {
    ros::NodeHandle node;
    ros::NodeHandle own("~");
    pose = node.advertise<geometry_msgs::PoseWithCovarianceStamped>("amcl_pose", 20, true);
    places = node.advertise<geometry_msgs::PoseArray>("particlecloud", 2, true);
    diagnostics = node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
    path = own.advertise<nav_msgs::Path>("path", 1, true);
    beams = own.advertise<visualization_msgs::Marker>("beams", 2);
    subscribers = {
        node.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
            "initialpose", 2,
            [&on](const geometry_msgs::PoseWithCovarianceStamped::ConstPtr& m) {
              on.on_initial_pose(plain(*m));
            }),
        node.subscribe<nav_msgs::OccupancyGrid>(
            "map", 1, [&on](const nav_msgs::OccupancyGrid::ConstPtr& m) { on.on_map(plain(*m)); })};
    for (const std::string& topic : scan_topics)
      subscribers.push_back(node.subscribe<sensor_msgs::LaserScan>(
          topic, kScansWaiting, [&on](const sensor_msgs::LaserScan::ConstPtr& m) { on.on_scan(plain(*m)); },
          {}, ros::TransportHints().tcpNoDelay()));
    for (const auto& [topic, is_static] : {std::pair("/tf", false), std::pair("/tf_static", true)})
      subscribers.push_back(hear_tf_of_others(node, topic, is_static, on));
    send_map(sent_map);
    using Empty = std_srvs::Empty;
    using Trigger = std_srvs::Trigger;
    services = {
        node.advertiseService<Empty::Request, Empty::Response>(
            "global_localization", [&on](auto&, auto&) { return told(on.on_global_localization()); }),
        node.advertiseService<Empty::Request, Empty::Response>(
            "request_nomotion_update", [&on](auto&, auto&) { return told(on.on_request_nomotion_update()); }),
        node.advertiseService<Trigger::Request, Trigger::Response>("save_pose",
                                                                   [&on](auto&, auto& response) {
                                                                     const Answer answer = on.on_save_pose();
                                                                     response.success = answer.is_done;
                                                                     response.message = answer.words;
                                                                     return true;
                                                                   }),
        node.advertiseService<nav_msgs::SetMap::Request, nav_msgs::SetMap::Response>(
            "set_map", [&on](auto& request, auto& response) {
              response.success = told(on.on_set_map(plain(request.map), plain(request.initial_pose)));
              return true;
            })};
  }

  void send_map(const GridMessage& sent_map) {
    if (sent_map.percent.empty()) return;
    if (!map) map = ros::NodeHandle().advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    map.publish(ros_grid(sent_map));
  }

  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener;
  tf2_ros::TransformBroadcaster broadcaster;
  ros::Publisher pose, places, diagnostics, path, beams, map;
  std::vector<ros::Subscriber> subscribers;
  std::vector<ros::ServiceServer> services;
};

RosLink::RosLink(int& argc, char** argv, const std::string& name) {
  // The log is written in the characters of the locale, and words hold others than ASCII.
  std::setlocale(LC_CTYPE, "C.UTF-8");
  ros::init(argc, argv, name);
  ros::start();
}

RosLink::~RosLink() {
  wires_.reset();
  ros::shutdown();
}

std::map<std::string, std::string> RosLink::parameters() const {
  Parameters parameters;
  XmlRpc::XmlRpcValue tree;
  if (ros::param::get(ros::this_node::getName(), tree)) flatten("", tree, parameters);
  return parameters;
}

void RosLink::run(const Handlers& handlers, const std::vector<std::string>& scan_topics) {
  handlers_ = handlers;
  scan_topics_ = scan_topics;
  wires_ = std::make_unique<Wires>(handlers_, scan_topics_, map_);
  ros::NodeHandle node;
  const auto tick =
      node.createWallTimer(ros::WallDuration(kTick_s), [this](const auto&) { handlers_.on_tick(); });
  const auto master = node.createWallTimer(ros::WallDuration(kLookAfterMaster_s),
                                           [this](const auto&) { look_after_master(); });
  ros::spin();
}

void RosLink::look_after_master() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  request[1] = ros::this_node::getName();
  const bool is_away = !ros::master::check();
  if (is_away && !is_master_away_)
    ROS_WARN("the ROS master does not answer; going on without it until it does");
  if (!is_away && is_master_away_) ROS_INFO("the ROS master is back");
  is_master_away_ = is_away;
  // A master that knows us answers 1; one that was started anew answers -1, and execute() is false.
  if (is_away || ros::master::execute("lookupNode", request, response, payload, false) ||
      !ros::master::check())
    return;
  ROS_WARN("the ROS master does not know this node, as after a restart: subscribing and advertising again");
  wires_.reset();
  if (ros::Time::isSimTime()) hear_clock_again();
  handlers_.on_new_master();
  wires_ = std::make_unique<Wires>(handlers_, scan_topics_, map_);
}

std::int64_t RosLink::now_ns() { return static_cast<std::int64_t>(ros::Time::now().toNSec()); }

double RosLink::steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TransformAnswer RosLink::transform(const std::string& target, const std::string& source,
                                   std::int64_t stamp_ns) {
  using Kind = TransformAnswer::Kind;
  const auto then = [&] { return wires_->buffer.lookupTransform(target, source, ros_time(stamp_ns)); };
  const auto latest = [&] { return wires_->buffer.lookupTransform(target, source, ros::Time(0)); };
  try {
    return {Kind::known, plain(then().transform), ""};
  } catch (const tf2::ExtrapolationException& error) {
    // Too new may come yet, too old will not.
    try {
      const bool may_come = latest().header.stamp < ros_time(stamp_ns);
      if (may_come) return {Kind::not_yet, {}, error.what()};
      // It may just have come, while the error was on its way.
      return {Kind::known, plain(then().transform), ""};
    } catch (const tf2::TransformException&) {
      return {Kind::unknown, {}, error.what()};
    }
  } catch (const tf2::TransformException& error) {
    return {Kind::unknown, {}, error.what()};
  }
}

void RosLink::send_pose(const PoseMessage& pose) { wires_->pose.publish(ros_pose(pose)); }
void RosLink::send_transform(const TransformMessage& t) {
  wires_->broadcaster.sendTransform(ros_transform(t));
}
void RosLink::send_places(const PosesMessage& places) { wires_->places.publish(ros_pose_array(places)); }
void RosLink::send_path(const PosesMessage& path) { wires_->path.publish(ros_path(path)); }
void RosLink::send_beams(const PointsMessage& beams) { wires_->beams.publish(ros_points(beams)); }

void RosLink::send_map(const GridMessage& map) {
  map_ = map;
  if (wires_) wires_->send_map(map_);
}

bool RosLink::wants_beams() { return wires_->beams.getNumSubscribers() > 0; }

void RosLink::send_diagnostic(const DiagnosticMessage& diagnostic) {
  diagnostic_msgs::DiagnosticStatus status;
  status.level = static_cast<diagnostic_msgs::DiagnosticStatus::_level_type>(diagnostic.level);
  status.name = ros::this_node::getName().substr(1) + ": localization";
  status.hardware_id = "none";
  status.message = diagnostic.message;
  for (const auto& [key, value] : diagnostic.values) {
    status.values.emplace_back();
    status.values.back().key = key;
    status.values.back().value = value;
  }
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.push_back(status);
  wires_->diagnostics.publish(array);
}

void RosLink::log(Level level, const std::string& words) {
  if (level == Level::ok) ROS_INFO("%s", words.c_str());
  if (level == Level::warn) ROS_WARN("%s", words.c_str());
  if (level == Level::error) ROS_ERROR("%s", words.c_str());
}

void RosLink::keep_parameter(const std::string& name, double value) {
  if (!is_master_away_) ros::param::set("~" + name, value);
}

}  // namespace beaconless::ros1
