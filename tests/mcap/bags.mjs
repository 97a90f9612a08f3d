// SPDX-License-Identifier: Apache-2.0
// Bags of ROS 2 (SQLite) and ROS 1 read by others' programs, which know nothing of ours: messages by topic.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { kLaserScan, optional, packages } from "./foreign.mjs";

const { rosmsg, cdr, lz4js } = packages();
const require = createRequire(import.meta.url);

const kBar = "=".repeat(80);
const kTime = `${kBar}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n`;
const kTransforms = `geometry_msgs/TransformStamped[] transforms
${kBar}
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
${kBar}
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
${kBar}
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
${kBar}
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
${kBar}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
`;
const kSchemas = { "sensor_msgs/msg/LaserScan": kLaserScan + kTime, "tf2_msgs/msg/TFMessage": kTransforms + kTime };

/// A db3 through the program sqlite3; nothing where that is absent.
export function readDatabase(path) {
  try {
    execFileSync("sqlite3", ["-version"]);
  } catch {
    console.log("the program sqlite3 is absent: .db3 files are not checked");
    return undefined;
  }
  const rows = JSON.parse(execFileSync("sqlite3", ["-json", "-readonly", path,
    "PRAGMA integrity_check; SELECT name, type, serialization_format, offered_qos_profiles AS qos, timestamp, " +
    "hex(data) AS data FROM messages m JOIN topics t ON t.id = m.topic_id ORDER BY timestamp, m.id"],
    { encoding: "utf8", maxBuffer: 1 << 30 }).replace(/^\[.*?\]\s*/s, ""));
  const topics = {};
  for (const { name, type, serialization_format, qos, timestamp, data } of rows) {
    if (serialization_format !== "cdr") throw new Error(`${name} is ${serialization_format}`);
    if (!kSchemas[type]) continue;
    const reader = new cdr.MessageReader(rosmsg.parse(kSchemas[type], { ros2: true }));
    const found = (topics[name] ??= { type, qos, messages: [], log: [] });
    found.messages.push(reader.readMessage(Buffer.from(data, "hex")));
    found.log.push(timestamp);
  }
  return topics;
}

/// A ROS 1 bag through @foxglove/rosbag; nothing where that is absent.
export async function readBag(path) {
  const rosbag = optional("@foxglove/rosbag");
  const node = optional("@foxglove/rosbag/node");
  if (!rosbag || !node) {
    console.log("@foxglove/rosbag is absent: ROS 1 bags are not checked by it");
    return undefined;
  }
  const bag = new rosbag.Bag(new node.FileReader(path), {
    parse: true,
    decompress: { lz4: (bytes, size) => lz4js.decompress(bytes, size) },
  });
  await bag.open();
  const topics = {};
  for (const { topic, type, latching } of bag.connections.values()) topics[topic] = { type, latching, messages: [] };
  for await (const { topic, message } of bag.messageIterator()) topics[topic].messages.push(message);
  return topics;
}
