// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_writer.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <utility>

#include <boost/make_shared.hpp>
#include <rosbag/bag.h>

namespace beaconless::io {
namespace {

/// A topic by the headers with which librosbag keeps it apart from others.
struct Connection {
  std::string type;
  Rosbag1Type about;
  boost::shared_ptr<ros::M_string> header;
};

/// A message whose bytes are there already.
struct Serialized {
  const Connection* connection;
  std::string_view bytes;
};

}  // namespace
}  // namespace beaconless::io

// How librosbag asks a message what it is.
namespace ros {
namespace message_traits {

template <>
struct MD5Sum<beaconless::io::Serialized> {
  static const char* value(const beaconless::io::Serialized& m) { return m.connection->about.md5.c_str(); }
};
template <>
struct DataType<beaconless::io::Serialized> {
  static const char* value(const beaconless::io::Serialized& m) { return m.connection->type.c_str(); }
};
template <>
struct Definition<beaconless::io::Serialized> {
  static const char* value(const beaconless::io::Serialized& m) {
    return m.connection->about.definition.c_str();
  }
};

}  // namespace message_traits
namespace serialization {

template <>
struct Serializer<beaconless::io::Serialized> {
  template <class Stream>
  static void write(Stream& stream, const beaconless::io::Serialized& m) {
    std::memcpy(stream.advance(serializedLength(m)), m.bytes.data(), m.bytes.size());
  }
  // NOLINTNEXTLINE(readability-identifier-naming): librosbag asks for this name
  static std::uint32_t serializedLength(const beaconless::io::Serialized& m) {
    return static_cast<std::uint32_t>(m.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace beaconless::io {

struct Rosbag1Writer::Librosbag {
  rosbag::Bag bag;
  std::map<std::pair<std::string, std::string>, Connection> connections;  ///< by topic and type
};

Rosbag1Writer::Rosbag1Writer(const std::string& path, Rosbag1Compression compression, TypeOf type_of)
    : type_of_(std::move(type_of)), librosbag_(std::make_unique<Librosbag>()) {
  try {
    librosbag_->bag.open(path, rosbag::bagmode::Write);
    librosbag_->bag.setCompression(compression == Rosbag1Compression::bz2 ? rosbag::compression::BZ2
                                   : compression == Rosbag1Compression::lz4
                                       ? rosbag::compression::LZ4
                                       : rosbag::compression::Uncompressed);
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

Rosbag1Writer::~Rosbag1Writer() { static_cast<void>(finish()); }

void Rosbag1Writer::fail(const char* says) {
  if (why_.empty()) why_ = std::string("cannot be written; librosbag says: ") + says;
  // Its destructor would close the file a second time, and throw once more.
  static_cast<void>(librosbag_.release());
}

void Rosbag1Writer::write(const RosMessageOut& message) {
  if (!librosbag_) return;
  auto key = std::pair{std::string(message.topic), std::string(message.type)};
  auto known = librosbag_->connections.find(key);
  if (known == librosbag_->connections.end()) {
    Connection connection{key.second, type_of_(key.second), boost::make_shared<ros::M_string>()};
    *connection.header = {{"type", connection.type},
                          {"md5sum", connection.about.md5},
                          {"message_definition", connection.about.definition},
                          {"callerid", "/beaconless"},
                          {"latching", message.is_latched ? "1" : "0"}};
    known = librosbag_->connections.emplace(std::move(key), std::move(connection)).first;
  }
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  constexpr std::int64_t kMost_ns =
      (std::int64_t{std::numeric_limits<std::uint32_t>::max()} + 1) * kSecond_ns - 1;
  last_ns_ = std::min(std::max(message.recorded_ns, last_ns_ + 1), kMost_ns);
  try {
    librosbag_->bag.write(known->first.first,
                          ros::Time(static_cast<std::uint32_t>(last_ns_ / kSecond_ns),
                                    static_cast<std::uint32_t>(last_ns_ % kSecond_ns)),
                          Serialized{&known->second, message.bytes}, known->second.header);
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

std::string Rosbag1Writer::finish() {
  if (!librosbag_) return why_;
  try {
    librosbag_->bag.close();
    librosbag_.reset();
  } catch (const std::exception& error) {
    fail(error.what());
  }
  return why_;
}

}  // namespace beaconless::io
