// SPDX-License-Identifier: Apache-2.0
// MCAP files read and written by the format's own library, which knows nothing of ours.
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";

const places = [process.env.BEACONLESS_NODE_MODULES, new URL(".", import.meta.url).pathname];
const require = createRequire(import.meta.url);

const load = (name) => require(require.resolve(name, { paths: places.filter(Boolean) }));

/// A package that is not needed; nothing where it is absent.
export function optional(name) {
  try {
    return load(name);
  } catch {
    return undefined;
  }
}

/// The packages, or the end of the program with "skipped" (exit code 77).
export function packages() {
  try {
    return {
      mcap: load("@mcap/core"),
      rosmsg: load("@foxglove/rosmsg"),
      cdr: load("@foxglove/rosmsg2-serialization"),
      fzstd: load("fzstd"),
      lz4js: load("lz4js"),
    };
  } catch (error) {
    console.log(`skipped: ${error.message.split("\n")[0]}`);
    console.log("to run it: npm install in tests/mcap, or set BEACONLESS_NODE_MODULES to a folder that has them");
    process.exit(77);
  }
}

const { mcap, rosmsg, cdr, fzstd, lz4js } = packages();

const decompressHandlers = {
  zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))),
  lz4: (bytes, size) => lz4js.decompress(bytes, Number(size)),
};

class Bytes {
  constructor(bytes) { this.bytes = bytes; }
  async size() { return BigInt(this.bytes.length); }
  async read(at, size) { return new Uint8Array(this.bytes.subarray(Number(at), Number(at + size))); }
}

/// Every message by topic, decoded by the schema that the file carries; checksums are checked.
function gather(topics, schemas, channels, message) {
  const channel = channels.get(message.channelId);
  const schema = schemas.get(channel.schemaId);
  const definitions = rosmsg.parse(new TextDecoder().decode(schema.data), { ros2: true });
  const reader = new cdr.MessageReader(definitions);
  const found = (topics[channel.topic] ??= { type: schema.name, messages: [], log: [] });
  found.messages.push(reader.readMessage(message.data));
  found.log.push(message.logTime);
}

export async function readIndexed(path) {
  const reader = await mcap.McapIndexedReader.Initialize({
    readable: new Bytes(readFileSync(path)),
    decompressHandlers,
  });
  const topics = {};
  for await (const message of reader.readMessages({ validateCrcs: true }))
    gather(topics, reader.schemasById, reader.channelsById, message);
  return { topics, statistics: reader.statistics, header: reader.header, chunks: reader.chunkIndexes };
}

export function readStreamed(path) {
  const reader = new mcap.McapStreamReader({ decompressHandlers, validateCrcs: true, includeChunks: true });
  reader.append(readFileSync(path));
  const topics = {};
  const schemas = new Map();
  const channels = new Map();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") gather(topics, schemas, channels, record);
  }
  if (!reader.done()) throw new Error(`${path}: the stream does not end`);
  return { topics };
}

export const kLaserScan = `std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
`;

/// Writes LaserScans with the library, laid out as `options` of its McapWriter say.
export async function write(path, scans, options) {
  const parts = [];
  let size = 0n;
  const writable = {
    async write(bytes) { parts.push(Buffer.from(bytes)); size += BigInt(bytes.length); },
    position: () => size,
  };
  const { compression, ...layout } = options;
  const lz4 = (data) => ({ compression: "lz4", compressedData: lz4js.compress(data) });
  const file = new mcap.McapWriter({ writable, chunkSize: 3000, ...layout,
                                     compressChunk: compression === "lz4" ? lz4 : undefined });
  await file.start({ profile: "ros2", library: "conformance" });
  const schemaId = await file.registerSchema({ name: "sensor_msgs/msg/LaserScan", encoding: "ros2msg",
                                               data: new TextEncoder().encode(kLaserScan) });
  const channelId = await file.registerChannel({ topic: "/scan", schemaId, messageEncoding: "cdr",
                                                 metadata: new Map([["offered_qos_profiles", ""]]) });
  await file.addAttachment({ name: "note", logTime: 0n, createTime: 0n, mediaType: "text/plain",
                             data: new TextEncoder().encode("not a message") });
  await file.addMetadata({ name: "robot", metadata: new Map([["serial", "1"]]) });
  const definitions = rosmsg.parse(kLaserScan + "=".repeat(80) +
      "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n", { ros2: true });
  const writer = new cdr.MessageWriter(definitions);
  let sequence = 0;
  for (const scan of scans) {
    const time = BigInt(scan.header.stamp.sec) * 1_000_000_000n + BigInt(scan.header.stamp.nanosec);
    await file.addMessage({ channelId, sequence: sequence++, logTime: time, publishTime: time,
                            data: writer.writeMessage(scan) });
  }
  await file.end();
  writeFileSync(path, Buffer.concat(parts));
}
