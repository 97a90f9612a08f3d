// SPDX-License-Identifier: Apache-2.0
// Holds our MCAP files against the format's own library: what we write it must read, what it writes we must read;
// and our bags of ROS 2 and ROS 1 against others' readers.
// usage: node conformance.mjs PROGRAM FOLDER; exit code 77 where node's packages are missing
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { readBag, readDatabase } from "./bags.mjs";
import { readIndexed, readStreamed, write } from "./foreign.mjs";

const [program, folder] = process.argv.slice(2);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const path = (name) => `${folder}/${name}`;
const run = (...words) => execFileSync(program, ["-q", ...words], { encoding: "utf8" });

let checks = 0;
function expect(good, what) {
  ++checks;
  if (!good) throw new Error(`not so: ${what}`);
}
const isSame = (a, b) => a.length === b.length && a.every((value, i) => Object.is(value, b[i]));

/// Ranges and stamps of the sweeps in a CARMEN log, as the floats that they stand for.
function sweepsOf(log) {
  const text = (log.endsWith(".gz") ? gunzipSync(readFileSync(log)) : readFileSync(log)).toString();
  return text.split("\n").filter((line) => line.startsWith("RAWLASER1")).map((line) => {
    const words = line.split(" ");
    const count = Number(words[8]);
    const [seconds, decimals] = words.at(-3).split(".");
    return { ranges: words.slice(9, 9 + count).map((word) => Math.fround(Number(word.replace("inf", "Infinity")))),
             sec: Number(seconds), nanosec: Number(decimals) };
  });
}

function expectSweeps(messages, sweeps, what) {
  expect(messages.length === sweeps.length, `${what}: ${messages.length} of ${sweeps.length} scans`);
  messages.forEach((message, i) => {
    expect(isSame(Array.from(message.ranges), sweeps[i].ranges), `${what}: ranges of scan ${i}`);
    expect(message.header.stamp.sec === sweeps[i].sec && message.header.stamp.nanosec === sweeps[i].nanosec,
           `${what}: stamp of scan ${i}`);
  });
}

// 1. What convert writes.
run("simulate", "small-rotation", "--out", path("sim"));
const sweeps = sweepsOf(path("sim/recording.log.gz"));
for (const compression of ["none", "lz4", "zstd"]) {
  const file = path(`${compression}.mcap`);
  run("convert", path("sim/recording.log.gz"), file, "--compression", compression);
  for (const [how, read] of [["indexed", await readIndexed(file)], ["streamed", readStreamed(file)]]) {
    expect(read.topics["/scan"].type === "sensor_msgs/msg/LaserScan", "the type of /scan");
    expectSweeps(read.topics["/scan"].messages, sweeps, `ours, ${compression}, ${how}`);
    if (how !== "indexed") continue;
    expect(read.statistics.messageCount === BigInt(sweeps.length), "the statistics");
    expect(read.header.profile === "ros2" && read.chunks.length > 1, "several chunks of ROS 2");
    expect(read.chunks.every((chunk) => chunk.compression === (compression === "none" ? "" : compression)),
           "the compression");
  }
}

// 2. What localize writes: every message by the schema beside it.
run("localize", path("sim/recording.log.gz"), "--map", path("sim/plan.yaml"), "--base-from-laser", "0.7,0,0",
    "--start-from", path("sim/truth.tum"), "--out-mcap", path("run.mcap"));
const { topics } = await readIndexed(path("run.mcap"));
for (const topic of ["/scan", "/tf", "/beaconless/pose", "/diagnostics"])
  expect(topics[topic].messages.length === sweeps.length, `${topic} of every scan`);
const pose = topics["/beaconless/pose"].messages[0];
expect(pose.header.frame_id === "map" && pose.pose.covariance.length === 36 && pose.pose.covariance[0] > 0 &&
       pose.pose.covariance[35] > 0, "the pose with its covariance");
const transform = topics["/tf"].messages[0].transforms[0];
expect(transform.header.frame_id === "map" && transform.child_frame_id === "base_link" &&
       transform.transform.translation.x === pose.pose.pose.position.x, "the transform map -> base_link");
const mounting = topics["/tf_static"].messages[0].transforms[0];
expect(mounting.child_frame_id === topics["/scan"].messages[0].header.frame_id &&
       mounting.transform.translation.x === 0.7, "the laser on the robot");
const status = topics["/diagnostics"].messages[0].status[0];
expect(status.level === 0 && status.name === "beaconless" && status.message === "ok" &&
       isSame(status.values.map(({ key }) => key),
              ["status", "reason", "quality", "protection_m", "protection_rad", "jumped"]), "the diagnostics");

// 3. What the library writes.
const scans = Array.from({ length: 50 }, (_, i) => ({
  header: { stamp: { sec: 1_700_000_000 + i, nanosec: 999_999_999 - i }, frame_id: "laser" },
  angle_min: -1, angle_max: 1, angle_increment: 2 / 99, time_increment: 0, scan_time: 0.1, range_min: 0.125,
  range_max: 30, intensities: [],
  ranges: Float32Array.from({ length: 100 }, (__, k) => (k % 9 === 0 ? Infinity : 1 + Math.sin(i + k) / 3 + k / 7)),
}));
const wanted = scans.map(({ header, ranges }) => ({ ranges: Array.from(ranges), ...header.stamp }));
const bare = { useStatistics: false, useSummaryOffsets: false, repeatSchemas: false, repeatChannels: false,
               useMessageIndex: false, useChunkIndex: false };
const layouts = { indexed: {}, lz4: { compression: "lz4" }, unchunked: { useChunks: false }, bare,
                  bareLz4: { ...bare, compression: "lz4" }, bareUnchunked: { ...bare, useChunks: false },
                  noChannels: { repeatChannels: false }, noStatistics: { useStatistics: false } };
for (const [name, layout] of Object.entries(layouts)) {
  const file = path(`foreign-${name}.mcap`);
  await write(file, scans, layout);
  const told = JSON.parse(run("info", file, "--json"));
  expect(told.topics.length === 1 && told.topics[0].count === scans.length, `info of ${name}`);
  run("convert", file, path(`foreign-${name}.log`));
  const read = sweepsOf(path(`foreign-${name}.log`));
  expectSweeps(read.map(({ ranges, sec, nanosec }) => ({ ranges, header: { stamp: { sec, nanosec } } })), wanted,
               `theirs, ${name}`);
}
// 4. Bags that convert writes, with the laser's place.
const isPlaced = (tf) => tf.messages.length === 1 && tf.messages[0].transforms[0].header.frame_id === "base_link" &&
    tf.messages[0].transforms[0].child_frame_id === mounting.child_frame_id &&
    tf.messages[0].transforms[0].transform.translation.x === 0.7;
run("convert", path("run.mcap"), path("run.db3"));
const database = readDatabase(path("run.db3"));
if (database) {
  expectSweeps(database["/scan"].messages, sweeps, "our db3");
  expect(isPlaced(database["/tf_static"]), "the laser in our db3");
  expect(database["/tf_static"].qos.includes("durability: 1") && database["/scan"].qos.includes("durability: 2"),
         "the settings of the publishers");
  const log = topics["/scan"].log.map(Number);
  expect(database["/scan"].log.every((ns, i) => Math.abs(Number(ns) - log[i]) < 1000), "the times of recording");
}
const said = execFileSync(program, ["convert", "--help"], { encoding: "utf8" });
expect(said.includes("ROS 1 bag"), "convert names its formats");
for (const compression of ["none", "lz4"]) {
  try {
    run("convert", path("run.mcap"), path(`${compression}.bag`), "--compression", compression);
  } catch (error) {
    if (!String(error.stderr).includes("built without")) throw error;
    console.log("this build has no ROS 1 bags: they are not checked");
    break;
  }
  const bag = await readBag(path(`${compression}.bag`));
  if (!bag) break;
  expect(bag["/scan"].type === "sensor_msgs/LaserScan", "the type of /scan in a bag");
  const messages = bag["/scan"].messages.map(({ ranges, header }) => (
      { ranges, header: { stamp: { sec: header.stamp.sec, nanosec: header.stamp.nsec } } }));
  expectSweeps(messages, sweeps, `our bag, ${compression}`);
  expect(isPlaced(bag["/tf_static"]) && bag["/tf_static"].latching, "the laser in our bag");
}
writeFileSync(path("checks.txt"), `${checks}\n`);
console.log(`conformance: ${checks} checks good`);
